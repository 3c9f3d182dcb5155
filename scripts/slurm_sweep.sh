#!/bin/bash
#SBATCH --job-name=plumb-sweep
#SBATCH --cpus-per-task=4
#SBATCH --time=02:00:00
#SBATCH --array=1-16
# Runs a sweep as a Slurm job array, each task a part of it, and joins the parts.
#
#   sbatch scripts/slurm_sweep.sh SCENE.toml FOLDER       the parts: FOLDER/part-K.jsonl
#   scripts/slurm_sweep.sh --merge FOLDER ALL.jsonl       once all tasks are over
#
# A task that was stopped goes on where it was when it is submitted again (`sbatch --array=3,7 ...` for some of them, with
# PLUMB_PARTS=16, the number of parts of the first time). `--array` and `--cpus-per-task` on the command line of sbatch go
# before what stands above. PLUMB names the command where it is not on the PATH.
set -euo pipefail
plumb=${PLUMB:-plumb}

if [[ ${1:-} == -h || ${1:-} == --help || $# -lt 2 ]]; then
  sed -n '2,/^[^#]/ { /^# /s/^# //p; /^#$/s/^#//p }' "$0"
  exit 0
fi
if [[ $1 == --merge ]]; then
  exec "$plumb" merge "$2"/part-*.jsonl -o "$3"
fi

scene=$1 folder=$2
part=${SLURM_ARRAY_TASK_ID:?this is a task of a job array: submit it with sbatch}
parts=${PLUMB_PARTS:-${SLURM_ARRAY_TASK_COUNT:?}}
mkdir -p "$folder"
exec "$plumb" sweep "$scene" --shard "$part/$parts" --threads "${SLURM_CPUS_PER_TASK:-1}" -o "$folder/part-$part.jsonl"
