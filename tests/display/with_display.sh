#!/bin/sh
# Runs a program that draws: on the present X server, else on one of its own of $FORESIGHT_SCREEN pixels (without the
# Composite extension, whose shared-memory errors fill the log).
set -eu
XDG_RUNTIME_DIR=$(mktemp -d)
trap 'rm -rf "$XDG_RUNTIME_DIR"' EXIT
chmod 700 "$XDG_RUNTIME_DIR"
# The OpenGL driver is unloaded before leaks are looked for: what it keeps has no name to suppress.
export ASAN_OPTIONS="${ASAN_OPTIONS:-}:detect_leaks=0"
export XDG_RUNTIME_DIR QT_QPA_PLATFORM=xcb QT_FONT_DPI=96 LIBGL_ALWAYS_SOFTWARE=1
if [ -n "${DISPLAY:-}" ]; then
  "$@"
else
  xvfb-run -a -s "-screen 0 ${FORESIGHT_SCREEN:-1600x1000}x24 -dpi 96 +extension GLX -extension Composite +render -noreset" "$@"
fi
