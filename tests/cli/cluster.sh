#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The chapter on clusters, on a real Slurm (its daemons, on this machine alone), with GNU parallel and with Snakemake: eight parts of a
# sweep, of which one is ended half way and continued, merge into the bytes of one run.
source "$(dirname "$0")/../shell.bash"
export PATH=$BUILD:$PATH
daemons=()
stop_daemons() { [ ${#daemons[@]} -eq 0 ] || { kill "${daemons[@]}" && wait "${daemons[@]}"; } 2>/dev/null; leave; }
trap stop_daemons EXIT

# The chapter's files; its sweep is small, with steps so short that a part takes a moment.
"$top/assets/manual/make.py" script cluster | sed -n '/^cat >/,/^END OF FILE/p' >"$T/files.sh"
small='s/cells: 32.*configurations: 200/cells: 8, magnetism: [0, 0.5], configurations: 48/; $a simulate: {step: 0.2 us}'
place() { rm -rf "$T/work" && mkdir "$T/work" && cd "$T/work" && bash "$T/files.sh" && sed -i "$small" sweep.yaml; }
ok "the chapter's files" place
ok "one run" exits 0 beadsim sweep.yaml -o whole
cp whole/sweep.h5 "$T/whole.h5"
merged() { beadsim --merge parts/sweep.*of8.h5 -o sweep.h5 && cmp sweep.h5 "$T/whole.h5"; }
job=
# Of its twelve chains it has not computed all anew.
continued() { grep -q '^1 file,' "$1" && ! grep -q ': 12 chains' "$1" || { cat "$1"; return 1; }; }

# A beadsim that at first is killed in part 3, when a chain of it is in its journal, behind the head. On Slurm its task then hangs.
mkdir "$T/bin"
cat >"$T/bin/beadsim" <<SH
#!/bin/sh
[ "\$3" = 3/8 ] && [ ! -e killed ] || exec "$beadsim" "\$@"
"$beadsim" "\$@" &
until [ "\$(stat -c %s parts/sweep.3of8.h5.part 2>/dev/null || echo 0)" -gt 72 ]; do sleep 0.01; done
kill -KILL \$!
touch killed
[ -z "\$SLURM_JOB_ID" ] || exec sleep 600
exit 1
SH
chmod +x "$T/bin/beadsim"
gnu_parallel() {
    PATH=$T/bin:$PATH parallel --will-cite -j 2 --joblog parts.log --resume-failed beadsim sweep.yaml --shard {}/8 -o parts --threads 1 ::: {1..8} >"$1" 2>&1
}
killed_and_resumed() {
    place && ! gnu_parallel first && [ -e killed ] && [ ! -e parts/sweep.3of8.h5 ] && gnu_parallel again && continued again &&
        [ "$(grep -c 'file,' again)" -eq 1 ]
}
if command -v parallel >/dev/null && parallel --version 2>/dev/null | grep -q 'GNU parallel'; then
    ok "GNU parallel: a part is killed half way; only this one is run again, and goes on" killed_and_resumed
    ok "... and all parts merge into the bytes of one run" merged
else
    skip parallel "the sweep with GNU parallel"
fi

# Slurm's daemons, for one machine that has as many processors as the job asks for.
slurm() {
    local port=$((20000 + RANDOM % 20000)) host
    host=$(hostname -s)
    mkdir -p "$T/slurm/state" "$T/slurm/spool" && head -c 128 /dev/urandom >"$T/slurm/key" && chmod 600 "$T/slurm/key" || return 1
    chmod 755 "$T" "$T/slurm"
    munged --foreground --force --key-file="$T/slurm/key" --socket="$T/slurm/munge" --pid-file="$T/slurm/munged.pid" --seed-file="$T/slurm/seed" \
        --log-file="$T/slurm/munged.log" >"$T/slurm/munged.out" 2>&1 &
    daemons+=($!)
    cat >"$T/slurm/slurm.conf" <<CONF
ClusterName=beadreel
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=$port
SlurmdPort=$((port + 1))
AuthType=auth/munge
AuthInfo=socket=$T/slurm/munge
CredType=cred/munge
SlurmUser=$(id -un)
SlurmdUser=$(id -un)
StateSaveLocation=$T/slurm/state
SlurmdSpoolDir=$T/slurm/spool
SlurmctldPidFile=$T/slurm/slurmctld.pid
SlurmdPidFile=$T/slurm/slurmd.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
MpiDefault=none
ReturnToService=2
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerParameters=sched_min_interval=100000,sched_interval=1,bf_interval=1
SlurmdParameters=config_overrides
NodeName=$host NodeAddr=127.0.0.1 CPUs=32 State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
CONF
    export SLURM_CONF=$T/slurm/slurm.conf
    await test -S "$T/slurm/munge" || { cat "$T/slurm/munged.out"; return 1; }
    slurmctld -D >"$T/slurm/slurmctld.log" 2>&1 &
    daemons+=($!)
    (cd "$T/slurm" && exec slurmd -D) >"$T/slurm/slurmd.log" 2>&1 &
    daemons+=($!)
    await eval '[ "$(sinfo -h -o %t)" = idle ]' || { tail -n 5 "$T"/slurm/*.log; return 1; }
}
all_parts() { [ "$(find parts -name 'sweep.*of8.h5' | wc -l)" -eq 8 ] && [ -z "$(squeue -h)" ]; }
requeued() {
    place
    job=$(PATH=$T/bin:$PATH sbatch --parsable sweep.slurm) && await test -e killed && scontrol requeue "${job}_3" || return 1
    # By itself, Slurm would wait for two minutes; it says so again when the task has ended. An order that comes before that does not count, and it waits.
    patience=180 await eval "scontrol update jobid=${job}_3 starttime=now; sleep 2; grep '^1 file,' slurm-${job}_3.out && all_parts" && continued "slurm-${job}_3.out"
}
missing=
for program in munged slurmctld slurmd sbatch; do command -v $program >/dev/null || missing=slurm-wlm,munge; done
if [ -z "$missing" ]; then
    ok "Slurm's daemons" slurm
    ok "... run the array; a task is requeued half way, and goes on" requeued
    ok "... and all parts merge into the bytes of one run" merged
else
    skip $missing "the array on Slurm"
fi

snakemake_works() { place && snakemake --cores 2 >log 2>&1 && [ -s force.pdf ] && cmp sweep.h5 "$T/whole.h5" || { tail -n 5 log; return 1; }; }
if command -v snakemake >/dev/null; then ok "Snakemake: force.pdf by the same bytes" snakemake_works; else skip snakemake "the rules for Snakemake"; fi
finish
