#!/bin/bash
# display.sh OPTIONS COMMAND...: runs a command on an X server of its own with these options (one
# word), which takes a free number itself. xvfb-run -a looks for one and takes it later: two that
# start at once can get the same one, and one of them no display.
# shellcheck disable=SC2086
exec 3< <(exec Xvfb -displayfd 1 $1 -nolisten tcp 2>/dev/null)
server=$!
trap 'kill $server 2>/dev/null' EXIT
read -r number <&3 || { echo "display.sh: Xvfb does not start" >&2; exit 1; }
export DISPLAY=":$number"
unset XAUTHORITY
shift
"$@" 3<&-
