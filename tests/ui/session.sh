#!/bin/sh
# Runs a test of the window in a session of its own: bus, display, and a folder for run-time files
# (the accessibility bus keeps its socket there; two tests at once would share it, and the first to
# end would take it from the other). Test output goes to standard output, all else to standard error.
exec 9>&1 >&2
folder=$(mktemp -d /tmp/sealbench-session-XXXXXX) || exit 1
trap 'rm -rf "$folder"' EXIT
trap 'exit 1' HUP INT TERM
export XDG_RUNTIME_DIR="$folder"
dbus-run-session -- "$(dirname "$0")/display.sh" '-screen 0 1400x1000x24' "$@"
