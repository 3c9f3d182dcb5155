#!/bin/bash
# compare_programs.sh BUILD_DIR...: runs each stage_hashes with several numbers of threads, with the kernels for older
# instruction sets, and as on an older processor;
# every output must be the same. A build that is not there is named and left out; fewer than two leave nothing to compare (77).
set -uo pipefail
expected=""
expected_by=""
differences=0
programs=0

check() {
  local name=$1 output=$2
  if [[ -z $expected ]]; then
    expected=$output
    expected_by=$name
    printf '%s\n' "$output"
  elif [[ $output != "$expected" ]]; then
    differences=$((differences + 1))
    echo "DIFFERENT: $name (<) and $expected_by (>)"
    diff <(printf '%s\n' "$output") <(printf '%s\n' "$expected")
  fi
}

run() {
  local name=$1
  shift
  local output
  if ! output=$("$@"); then
    echo "FAILED: $name"
    differences=$((differences + 1))
    return
  fi
  check "$name" "$output"
}

for folder in "$@"; do
  program=$folder/stage_hashes
  name=$(basename "$folder")
  if [[ ! -x $program ]]; then
    echo "left out: $name was not built"
    continue
  fi
  programs=$((programs + 1))
  for threads in 1 2 7; do
    run "$name, $threads threads" "$program" $threads
  done
  for isa in sse2 avx2; do
    [[ $isa == sse2 ]] || grep -qw "$isa" /proc/cpuinfo || continue
    run "$name, $isa kernels" env PLUMB_ISA=$isa "$program" 2
  done
  run "$name, no FMA and AVX2" env GLIBC_TUNABLES=glibc.cpu.hwcaps=-FMA,-AVX2 "$program" 2
done

if ((differences > 0)); then
  echo "$differences outputs differ from the first"
  exit 1
fi
echo "$programs programs, all outputs equal"
((programs >= 2)) || exit 77
