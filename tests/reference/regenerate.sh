#!/bin/sh
# Renews tests/reference/golden/ from the scenes. Run it in the root of the project; needs gcc and Python 3.11.
set -eu
here=tests/reference
program=$(mktemp)
trap 'rm -f "$program"' EXIT
gcc -O2 -o "$program" $here/*.c -lquadmath -lm

# golden SCENE NAME
golden() {
    python3 $here/scene_to_input.py "$1" --step 0.5 |
        "$program" - $here/golden/"$2" --proof --made-by "$here/regenerate.sh from $1"
}

golden examples/scenes/feup.toml feup
for scene in $here/scenes/*.toml; do
    golden "$scene" "$(basename "$scene" .toml)"
done
