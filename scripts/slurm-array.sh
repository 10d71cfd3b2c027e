#!/usr/bin/env bash
# One shard of a batch for each task of a Slurm job array, all into one folder. It needs the program
# and a folder that all nodes see, nothing else.
#
#     sbatch --array=1-64 --cpus-per-task=4 --time=2:00:00 --signal=TERM@60 \
#         scripts/slurm-array.sh BATCH.toml DIR [FLAGS OF batch]…
#
# Tasks count from 1. Send the same job again after a walltime or a lost node: rows that are done are
# left. FFSM_IPOPT names the program where it is not on the path.
set -euo pipefail

if [[ $# -lt 2 || -z ${SLURM_ARRAY_TASK_ID-} || -z ${SLURM_ARRAY_TASK_COUNT-} ]]; then
  echo "usage: sbatch --array=1-N $0 BATCH.toml DIR [FLAG]..." >&2
  exit 2
fi
batch=$1 folder=$2
shift 2
# The program itself gets the signal that comes before the walltime.
exec "${FFSM_IPOPT:-ffsm-ipopt}" batch "$batch" --out "$folder" --resume \
  --shard "$SLURM_ARRAY_TASK_ID/$SLURM_ARRAY_TASK_COUNT" \
  --jobs "${SLURM_CPUS_PER_TASK:-1}" --quiet "$@"
