#!/bin/bash
# examples.sh BIN_DIR: runs every examples/*/run.sh in an empty folder of its own with BIN_DIR/plumb. Status 1 if one fails, or
# leaves no report, or if there is none.
set -euo pipefail
bin_dir=$(cd "$1" && pwd)
examples=$(cd "$(dirname "${BASH_SOURCE[0]}")/../../examples" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
shopt -s nullglob
scripts=("$examples"/*/run.sh)
if ((${#scripts[@]} == 0)); then
  echo "$examples has no run.sh"
  exit 1
fi
failed=0
for script in "${scripts[@]}"; do
  name=$(basename "$(dirname "$script")")
  mkdir "$work/$name"
  echo "== $name"
  status=0
  (cd "$work/$name" && sh "$script" "$bin_dir/plumb") > "$work/$name.log" 2>&1 || status=$?
  cat "$work/$name.log"
  if ((status != 0)); then
    echo "$name ended with status $status"
    failed=1
  elif [[ ! -s $work/$name/report/report.html ]]; then
    echo "$name left no report"
    failed=1
  elif (($(grep -c ' fits if ' "$work/$name.log") != 3)); then
    echo "$name did not name its three wrong readings"
    failed=1
  fi
done
exit "$failed"
