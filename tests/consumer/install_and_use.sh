#!/bin/bash
# install_and_use.sh BUILD_DIR PROGRAM_DIR COMPILER: installs the build into an empty prefix, then configures, builds and
# runs the program against that prefix alone, from copies outside the tree.
set -euo pipefail
build_dir=$1 program_dir=$2 compiler=$3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

cmake --install "$build_dir" --prefix "$work/prefix" > "$work/install.log" || { cat "$work/install.log"; exit 1; }
if grep -rIl -e "$build_dir" "$work/prefix"; then
  echo "the files above name the folder that they were built in"
  exit 1
fi
cp -r "$program_dir" "$work/program"
cmake -S "$work/program" -B "$work/build" -DCMAKE_PREFIX_PATH="$work/prefix" -DCMAKE_CXX_COMPILER="$compiler" \
  -DCMAKE_BUILD_TYPE=Release > "$work/configure.log" 2>&1 || { cat "$work/configure.log"; exit 1; }
cmake --build "$work/build"
"$work/build/outside"
"$work/prefix/bin/plumb" --version
