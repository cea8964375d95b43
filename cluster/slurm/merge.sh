#!/bin/bash
# Makes the films and the report of a plan whose shards are rendered:
#
#   sbatch --dependency=afterany:JOB merge.sh plan.jsonl
#
# Where frames are missing the job ends with exit code 3, and its log says which; also where all is done, but a game
# could not be read to its end.

#SBATCH --job-name=lightsquare-merge
#SBATCH --time=01:00:00
# Threads; several films are made at once.
#SBATCH --cpus-per-task=4
#SBATCH --output=lightsquare-merge-%j.log
# With one # less these hold: which partition, how much memory, which account.
##SBATCH --partition=main
##SBATCH --mem=1G
##SBATCH --account=chess

plan=${1:-${PLAN:-plan.jsonl}}

# exec: signals reach the program itself.
exec lightsquare merge "$plan" --cpu "${SLURM_CPUS_PER_TASK:-1}"
