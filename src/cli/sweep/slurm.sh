#!/bin/bash
# {points} points in {shards} shards. Submit with: sbatch FILE   (a throttle: sbatch --array=0-{last}%4 FILE)
# When all tasks are done: mdr-tui sweep --merge {directory} --out map.csv
#SBATCH --job-name=sweep
#SBATCH --array=0-{last}
#SBATCH --ntasks=1
#SBATCH --cpus-per-task=1
{wanted}#SBATCH --signal=B:TERM@60
#SBATCH --requeue
#SBATCH --open-mode=append
#SBATCH --output=%x-%A_%a.log

{modules}program= signals=0
trap 'signals=$((signals + 1)); [ -z "$program" ] || kill -TERM "$program" 2>/dev/null' TERM
mdr-tui sweep {study} --shards {shards} --resume --out {directory}/shard-"$SLURM_ARRAY_TASK_ID".csv \
    --threads "${{SLURM_CPUS_PER_TASK:-1}}" --quiet{more} &
program=$!
[ "$signals" = 0 ] || kill -TERM "$program"
# A trapped signal ends wait before the program ends; then wait again. 127: there was nothing left.
status= seen=
while [ "$signals" != "$seen" ]; do
    seen=$signals
    wait "$program"; code=$?
    [ "$code" = 127 ] || status=$code
done
if [ "$status" = {unfinished} ] && [ "${{SLURM_RESTART_COUNT:-0}}" -lt {most_requeues} ]; then
    scontrol requeue "$SLURM_JOB_ID"
fi
exit "$status"
