#!/bin/bash
# golden_stages.sh STAGE_HASHES FILE [--update]: every stage's checksum is the one on record. Reports and audits are left out: their
# words change with every good idea, and what they measure has tests of its own.
set -uo pipefail
program=$1
record=$2

if ! hashes=$("$program" 2); then
  echo "FAILED: $program"
  exit 1
fi
hashes=$(printf '%s\n' "$hashes" | grep -vE '^(report|audit)\.')
if [[ ${3:-} == --update ]]; then
  printf '%s\n' "$hashes" > "$record"
  exit
fi
if ! diff <(printf '%s\n' "$hashes") "$record"; then
  echo "Stages whose bits are others (<) than on record (>). The first of them has the cause. If it is meant:"
  echo "  bash ${BASH_SOURCE[0]} $program $record --update"
  echo "and the commit says why."
  exit 1
fi
echo "$(wc -l < "$record") stages as on record"
