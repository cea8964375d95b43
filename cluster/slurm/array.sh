#!/bin/bash
# Renders one shard of a plan in each task of a job array. `plan` and `verify` print the list of tasks:
#
#   sbatch "$(lightsquare plan game.pgn --shards 8 -o plan.jsonl)" array.sh plan.jsonl
#
# The job begins in the folder where sbatch was called. Slurm runs a copy of this script that is elsewhere, so
# nothing can be looked for beside it.

#SBATCH --job-name=lightsquare
# How long a task may take. At the end it gets SIGTERM, then KillWait's seconds (30 as a rule) to stop.
#SBATCH --time=02:00:00
# Threads of a task.
#SBATCH --cpus-per-task=4
# One file of messages for each task; those of a task that begins again are added to it.
#SBATCH --output=lightsquare-%A_%a.log
#SBATCH --open-mode=append
# A task that was preempted or lost its node begins again, and keeps the frames that are there.
#SBATCH --requeue
# With one # less these hold: which partition, how much memory, which account.
##SBATCH --partition=main
##SBATCH --mem=1G
##SBATCH --account=chess

plan=${1:-${PLAN:-plan.jsonl}}

# exec: the program takes the place of the shell. Otherwise the shell would end at SIGTERM, and Slurm would
# kill the program before it could stop by itself. The shard is SLURM_ARRAY_TASK_ID's.
exec lightsquare render --plan "$plan" --cpu "${SLURM_CPUS_PER_TASK:-1}"
