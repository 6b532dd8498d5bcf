#!/usr/bin/env bash
# A study of 1,000 points as a Slurm array of 16 tasks against the same study run locally: one task is
# requeued, one is killed and requeued, one meets its time limit. The merged table must be the same,
# byte for byte.
#
# Usage: tests/slurm/run.sh PROGRAM [DIR]       PROGRAM: target/release/mdr-tui or the like
# Needs: apt-get install -y --no-install-recommends slurm-wlm munge      (root)
#
# The cluster is one node on loopback, without systemd; its keys, sockets and state are in DIR and it
# is taken down at the end.
set -euo pipefail
PROGRAM=$(realpath "$1"); DIR=$(realpath -m "${2:-$(mktemp -d)}"); HOST=$(hostname -s)
mkdir -p "$DIR"/{bin,ctld,d,log,munge,work}
say() { printf '%s %s\n' "$(date +%T)" "$*"; }

down() {
    scancel --signal=KILL --full -u root 2>/dev/null || true
    scancel -u root 2>/dev/null || true
    for file in slurmd.pid slurmctld.pid munge/pid; do
        pid=$(cat "$DIR/$file" 2>/dev/null) || continue
        kill "$pid" 2>/dev/null || continue
        for _ in $(seq 50); do kill -0 "$pid" 2>/dev/null || continue 2; sleep 0.1; done
        kill -KILL "$pid" 2>/dev/null || true
    done
}
trap down EXIT

port() { python3 -c 'import socket; s = socket.socket(); s.bind(("127.0.0.1", 0)); print(s.getsockname()[1])'; }
head -c 1024 /dev/urandom > "$DIR/munge/key"
chmod 600 "$DIR/munge/key"; chmod 755 "$DIR" "$DIR/munge"
cat > "$DIR/slurm.conf" <<CONF
ClusterName=loopback
SlurmctldHost=$HOST(127.0.0.1)
SlurmctldPort=$(port)
SlurmdPort=$(port)
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
CredType=cred/munge
AuthInfo=socket=$DIR/munge/socket,cred_expire=5
StateSaveLocation=$DIR/ctld
SlurmdSpoolDir=$DIR/d
SlurmctldPidFile=$DIR/slurmctld.pid
SlurmdPidFile=$DIR/slurmd.pid
SlurmctldLogFile=$DIR/log/slurmctld.log
SlurmdLogFile=$DIR/log/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
CommunicationParameters=NoInAddrAny,NoCtldInAddrAny
AccountingStorageType=accounting_storage/none
MpiDefault=none
SwitchType=switch/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerParameters=batch_sched_delay=0,sched_interval=2,sched_min_interval=0
SchedulerType=sched/builtin
SlurmdParameters=config_overrides
ReturnToService=2
JobRequeue=1
KillWait=5
MaxArraySize=10001
NodeName=$HOST NodeAddr=127.0.0.1 CPUs=4 State=UNKNOWN
PartitionName=main Nodes=ALL Default=YES MaxTime=INFINITE OverTimeLimit=0 State=UP
CONF
export SLURM_CONF="$DIR/slurm.conf"
munged --force --key-file="$DIR/munge/key" --socket="$DIR/munge/socket" --pid-file="$DIR/munge/pid" \
    --log-file="$DIR/log/munged.log" --seed-file="$DIR/munge/seed" --num-threads=2
slurmctld -c
slurmd -c
for _ in $(seq 200); do
    [ "$(sinfo -h -o %t 2>/dev/null)" = idle ] && break
    sleep 0.1
done
[ "$(sinfo -h -o %t)" = idle ] || { say "the node did not come up"; tail -n 20 "$DIR"/log/*.log; exit 1; }
say "one node is up"

# Shards 5 and 13 have the long points.
cp "$PROGRAM" "$DIR/bin/mdr-tui"; export PATH="$DIR/bin:$PATH"; cd "$DIR/work"
cat > study.toml <<'TOML'
base = "li2019-fig3"
columns = ["wear_volume_m3", "dissipated_energy_J", "regime", "cycle"]
[set]
"numerics.points" = 24
"numerics.steps_per_cycle" = 12
"numerics.grid" = "uniform"
[[axis]]
key = "motion.tangential.amplitude"
logspace = [1e-8, 1e-6, 125]
[[axis]]
key = "run.cycles"
values = [1.0, 1.1, 1.2, 1.3, 1.4, 150.0, 1.6, 1.7]
TOML
mdr-tui sweep study.toml --out whole.csv --quiet
say "the local run is done"
mdr-tui sweep study.toml --shards 16 --slurm > job.sh
rows() { grep -c ',ok$' "study.shards/shard-$1.csv" 2>/dev/null || true; }
wait_for_rows() { for _ in $(seq 600); do [ "$(rows "$1")" -ge "$2" ] 2>/dev/null && return; sleep 0.05; done; say "no rows in shard $1"; exit 1; }

# The process of a shard, by the program that it runs.
process() {
    for place in /proc/[0-9]*; do
        [ "$(readlink "$place/exe" 2>/dev/null)" = "$DIR/bin/mdr-tui" ] || continue
        if tr '\0' ' ' < "$place/cmdline" | grep -q "/shard-$1.csv"; then echo "${place#/proc/}"; fi
    done
}

# Task 13 gets SIGTERM 57 s before its limit of a minute. It is frozen until then, so that it meets its
# limit on a fast machine as well.
SHORT=$(sbatch --parsable --array=13 --time=1 --signal=B:TERM@57 job.sh)
wait_for_rows 13 1
frozen=$(process 13)
kill -STOP "$frozen"
MAIN=$(sbatch --parsable --array=0-12,14,15 --time=10 job.sh)
say "submitted: $MAIN, and $SHORT with a short limit"
wait_for_rows 5 2
kill -KILL "$(process 5)"
say "task 5 killed with $(rows 5) rows"
for _ in $(seq 900); do
    pending=$(sed -n 's/^ShdPnd:[[:space:]]*//p' "/proc/$frozen/status")
    [ $((0x$pending & 0x4000)) != 0 ] && break          # SIGTERM waits
    sleep 0.1
done
kill -CONT "$frozen"
say "task 13 has met its limit"
for _ in $(seq 200); do squeue -h -j "${MAIN}_5" -t R 2>/dev/null | grep -q . || break; sleep 0.1; done
scontrol requeue "${MAIN}_5"
say "task 5 queued again"
scontrol requeue "${MAIN}_2" 2>/dev/null && say "task 2 queued again"
for _ in $(seq 2400); do [ -z "$(squeue -h 2>/dev/null)" ] && break; sleep 0.25; done
squeue
for log in *.log; do [ ! -s "$log" ] || sed "s/^/$log: /" "$log"; done
grep -q interrupted "sweep-${SHORT}_13.log" || { say "task 13 never met its limit"; exit 1; }
mdr-tui sweep --merge study.shards --out merged.csv
cmp whole.csv merged.csv
say "$(grep -c ',ok$' merged.csv) points, the same bytes as the local run"
