#!/bin/sh
# What the workstation with its emulated head takes while nothing moves: CPU time of the whole process,
# devices and software OpenGL included, in percent of one core.
#   tests/display/with_display.sh tests/benchmark/idle_workstation.sh [SECONDS]
set -eu
cd "$(dirname "$0")/../.."
seconds=${1:-30}
home=$(mktemp -d)
HOME=$home XDG_DATA_HOME=$home XDG_CONFIG_HOME=$home \
  build/release/bin/foresight --emulate resources/scenes/room.yaml 2> "$home/log" &
program=$!
trap 'kill $program; wait $program || true; rm -rf "$home"' EXIT
ticks() { awk '{print $14 + $15}' "/proc/$program/stat"; }
sleep 20  # the head is homed and the window has drawn itself
before=$(ticks)
sleep "$seconds"
after=$(ticks)
awk -v ticks=$((after - before)) -v hz="$(getconf CLK_TCK)" -v s="$seconds" \
  'BEGIN { printf "%.2f %% of a core over %d s\n", 100 * ticks / hz / s, s }'
