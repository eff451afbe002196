#!/usr/bin/env bash
# Runs a command in a network of its own that has an Avahi daemon of its own, so that nothing of
# this computer's network is told or found.
#   with_private_avahi.sh COMMAND...
# Exit 77 where that cannot be had: no avahi-daemon, no dbus-daemon, or this user may not.
set -euo pipefail

if [ "${1:-}" != --inside ]; then
  for program in /usr/sbin/avahi-daemon dbus-daemon; do
    command -v "$program" >/dev/null || { echo "skipped: $program is not installed"; exit 77; }
  done
  unshare -mn true 2>/dev/null || { echo "skipped: only root may make a network of its own"; exit 77; }
  exec unshare -mn --propagation private "$0" --inside "$@"
fi
shift

ip link set lo up
ip link set lo multicast on
ip address add 10.77.0.1/24 dev lo
ip route add 224.0.0.0/4 dev lo
mount -t tmpfs tmpfs /run
mkdir -p /run/dbus /run/avahi-daemon
cat >/run/dbus.conf <<'EOF'
<!DOCTYPE busconfig PUBLIC "-//freedesktop//DTD D-Bus Bus Configuration 1.0//EN" "http://www.freedesktop.org/standards/dbus/1.0/busconfig.dtd">
<busconfig>
  <type>system</type>
  <listen>unix:path=/run/dbus/system_bus_socket</listen>
  <policy context="default">
    <allow own="*"/> <allow send_destination="*"/> <allow receive_sender="*"/>
  </policy>
</busconfig>
EOF
printf '[server]\nhost-name=robot\nuse-ipv6=no\nallow-interfaces=lo\n[publish]\npublish-workstation=no\n' >/run/avahi.conf
export DBUS_SYSTEM_BUS_ADDRESS=unix:path=/run/dbus/system_bus_socket
dbus-daemon --config-file=/run/dbus.conf --nofork &
bus=$!
trap 'kill $(jobs -p) 2>/dev/null || true' EXIT
for _ in $(seq 100); do [ -S /run/dbus/system_bus_socket ] && break; sleep 0.05; done
/usr/sbin/avahi-daemon --file=/run/avahi.conf --no-rlimits --no-drop-root --no-chroot >/run/avahi.log 2>&1 &
for _ in $(seq 200); do [ -e /run/avahi-daemon/pid ] && grep -q "Server startup complete" /run/avahi.log && break; sleep 0.05; done
grep -q "Server startup complete" /run/avahi.log || { cat /run/avahi.log >&2; exit 1; }
kill -0 $bus
"$@"
