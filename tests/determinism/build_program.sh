#!/bin/bash
# build_program.sh SOURCE_DIR BUILD_DIR COMPILER LEVEL: builds stage_hashes there. 77: no such compiler.
set -euo pipefail
source_dir=$1 build_dir=$2 compiler=$3 level=$4
if ! command -v "$compiler" > /dev/null; then
  echo "$compiler is not installed"
  exit 77
fi
generator="Unix Makefiles"
command -v ninja > /dev/null && generator=Ninja
cmake -S "$source_dir/program" -B "$build_dir" -G "$generator" -DCMAKE_BUILD_TYPE= \
  -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_CXX_FLAGS="$level"
cmake --build "$build_dir" --target stage_hashes -j "${PLUMB_BUILD_JOBS:-1}"
