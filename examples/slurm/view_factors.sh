#!/bin/bash
# Computes one part of the view factors of a scene in each job of an array, and joins the parts:
#
#   job=$(sbatch --parsable --array=1-16 view_factors.sh city.obj city.npz --eps 1e-4)
#   sbatch --dependency=afterok:$job view_factors.sh --merge city.npz
#
# A job that was killed goes on with its finished rows when it is submitted again.
#SBATCH --job-name=view-factors
#SBATCH --cpus-per-task=8
#SBATCH --requeue
set -euo pipefail

if [[ "${1:-}" == --merge ]]; then
  output=${2:?give the name of the whole file}
  exec steradian merge "${output%.npz}".part-*.npz -o "$output"
fi

scene=${1:?give a scene, an output and options} output=${2:?give the name of the whole file}
part=${SLURM_ARRAY_TASK_ID:?submit with sbatch --array=1-N}
parts=${SLURM_ARRAY_TASK_COUNT:?submit with sbatch --array=1-N}
shift 2
exec steradian viewfactor "$scene" -o "${output%.npz}.part-$part.npz" --part "$part/$parts" --resume "$@"
