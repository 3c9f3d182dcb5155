#!/bin/bash
# readme_commands.sh BIN_DIR [README]: runs every block of the README that is marked
#
#   <!-- run -->
#   ```sh
#   plumb ...
#   ```
#
# each in an empty folder of its own, with BIN_DIR first on PATH and `bash -eu`. Status 1 if a block fails, if a mark is not
# followed by a block that is closed, or if there is none.
set -euo pipefail
bin_dir=$(cd "$1" && pwd)
readme=${2:-$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)/README.md}
[[ -x $bin_dir/plumb ]] || { echo "there is no plumb in $bin_dir"; exit 1; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# Writes each block into a file named by the line on which it begins.
awk -v folder="$work" '
  function fail(message) { print FILENAME ":" FNR ": " message; failed = 1; exit 1 }
  in_block && /^```[[:space:]]*$/ { in_block = 0; close(file); next }
  in_block { print > file; next }
  marked && /^```sh[[:space:]]*$/ {
    marked = 0; in_block = 1; file = sprintf("%s/line-%05d.sh", folder, FNR); printf "" > file; next
  }
  marked && NF { fail("expected ```sh after <!-- run -->") }
  /^<!-- run -->[[:space:]]*$/ { marked = 1 }
  END { if (!failed && (marked || in_block)) fail("a marked block does not begin or does not end") }
' "$readme"

shopt -s nullglob
blocks=("$work"/line-*.sh)
if ((${#blocks[@]} == 0)); then
  echo "$readme has no block marked <!-- run -->"
  exit 1
fi
failed=0
for block in "${blocks[@]}"; do
  name=$(basename "$block" .sh)
  mkdir "$work/$name"
  echo "== $name"
  sed 's/^/  $ /' "$block"
  status=0
  (cd "$work/$name" && PATH=$bin_dir:$PATH bash -eu "$block") || status=$?
  if ((status != 0)); then
    echo "the block of $name ended with status $status"
    failed=1
  fi
done
exit "$failed"
