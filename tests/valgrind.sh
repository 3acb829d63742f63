#!/bin/sh
# Fifty pictures under valgrind, as a film: no leak, no wrong access. First argument: sealbench,
# second: the sources. Skipped (77) where valgrind is missing.
command -v valgrind >/dev/null || exit 77
folder=$(mktemp -d) || exit 1
trap 'rm -rf "$folder"' EXIT
# Among libav's libraries one may use an instruction of this processor that valgrind does not know:
# the pictures are then written one by one.
written=film.mp4
LD_PRELOAD=libavcodec.so valgrind -q true >/dev/null 2>&1
if [ $? -eq 132 ]; then
  echo "valgrind ends by SIGILL while it loads libav"
  written=%04d.png
fi
OPENBLAS_NUM_THREADS=1 G_SLICE=always-malloc valgrind -q --leak-check=full \
  --errors-for-leak-kinds=definite --show-leak-kinds=definite --error-exitcode=9 --num-callers=20 \
  --suppressions="$2/tests/valgrind.supp" \
  "$1" render "$2/assets/scenes/quick-look.scene" -o "$folder/$written" --view "${3:-section}" \
  --size 160x90 --fps 25 --duration 2s --quiet && [ -n "$(ls "$folder")" ]
