#!/bin/sh
# A film of a hundred pictures under valgrind: no leak, no wrong access. First argument: sealbench,
# second: the sources. Skipped (77) where valgrind is missing.
command -v valgrind >/dev/null || exit 77
# A library may use, before main(), an instruction of this processor that valgrind does not know.
valgrind -q "$1" --version >/dev/null 2>&1
if [ $? -eq 132 ]; then
  echo "valgrind ends by SIGILL while it loads the program's libraries"
  exit 77
fi
folder=$(mktemp -d) || exit 1
trap 'rm -rf "$folder"' EXIT
OPENBLAS_NUM_THREADS=1 G_SLICE=always-malloc valgrind -q --leak-check=full \
  --errors-for-leak-kinds=definite --show-leak-kinds=definite --error-exitcode=9 --num-callers=20 \
  --suppressions="$2/tests/valgrind.supp" \
  "$1" render "$2/assets/scenes/quick-look.scene" -o "$folder/film.mp4" --view "${3:-section}" \
  --size 160x90 --fps 25 --duration 4s --quiet && [ -s "$folder/film.mp4" ]
