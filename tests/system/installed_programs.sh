#!/bin/sh
# Installs a build into an empty folder and runs the programs there, with nothing of the build in reach.
#   installed_programs.sh CMAKE BUILD_FOLDER
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$1" --install "$2" --prefix "$folder/usr" >"$folder/log" || { cat "$folder/log" >&2; exit 1; }
bin=$folder/usr/bin
for program in "$bin"/foresight*; do
  if ldd "$program" | grep -e 'not found' -e "$2"; then
    echo "$program: takes libraries that are not installed" >&2
    exit 1
  fi
  QT_QPA_PLATFORM=offscreen "$program" --version
done
"$bin/foresightctl" mission import --help >"$folder/help"  # from a library that is loaded late
grep -q bag "$folder/help"
[ -f "$folder/usr/share/foresight/scenes/valve.yaml" ]
"$bin/foresightctl" scan --scene "$folder/usr/share/foresight/scenes/valve.yaml" --from 0 --to 5 \
  --out "$folder/m.foresight" 2>"$folder/log" || { cat "$folder/log" >&2; exit 1; }
"$bin/foresightctl" mission list "$folder/m.foresight"
[ -f "$folder/usr/lib/systemd/system/foresight-head.service" ]
