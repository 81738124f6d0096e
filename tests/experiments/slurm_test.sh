#!/usr/bin/env bash
# Runs in parts on the real scheduler: a controller and two nodes on this machine, of this test alone.
#
#   slurm_test.sh HAUBERK FOLDER EXPERIMENT.json PARTS [--set path=value ...]
#
# Submits the experiment with --array PARTS, kills one node half way, waits for the jobs and compares the results with
# those of one run, byte for byte. Prints times. Exit code 77: Slurm is not there.
#
# KILL=parts (the default): the node's daemon and its parts are killed, and what watches over them tells the controller
# that they ended; gathering submits them again. KILL=node: that is killed, too, as when the machine fails; Slurm puts
# the part back into its queue by itself, after two minutes.
set -euo pipefail
hauberk=$(realpath "$1") folder=$2 experiment=$3 parts=$4
shift 4
export PATH=$PATH:/usr/sbin
for program in slurmctld slurmd sbatch squeue scontrol sinfo; do
  command -v "$program" >/dev/null || { echo "no $program: skipped"; exit 77; }
done
[[ $(id -u) == 0 ]] || { echo "Slurm's daemons of this test want root: skipped"; exit 77; }

rm -rf "$folder"
mkdir -p "$folder"
folder=$(realpath "$folder")
export SLURM_CONF=$folder/slurm.conf
host=$(hostname -s) port=$((20000 + $$ % 20000))
cat >"$SLURM_CONF" <<END
ClusterName=test
SlurmctldHost=$host(127.0.0.1)
SlurmUser=root
AuthType=auth/none
CredType=cred/none
SlurmctldPort=$port
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool-%n
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd-%n.pid
SlurmctldLogFile=$folder/slurmctld.log
SlurmdLogFile=$folder/slurmd-%n.log
ProctrackType=proctrack/pgid
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerParameters=sched_interval=1,batch_sched_delay=0
ReturnToService=2
SlurmdTimeout=5
KillWait=1
MinJobAge=3600
MailProg=/bin/true
NodeName=n1 NodeHostname=$host NodeAddr=127.0.0.1 Port=$((port + 1)) CPUs=1 State=UNKNOWN
NodeName=n2 NodeHostname=$host NodeAddr=127.0.0.1 Port=$((port + 2)) CPUs=1 State=UNKNOWN
PartitionName=all Nodes=n1,n2 Default=YES MaxTime=INFINITE State=UP
END
mkdir "$folder/state"

stop() {
  for node in n1 n2; do
    [[ -f $folder/slurmd-$node.pid ]] && kill -KILL "$(<"$folder/slurmd-$node.pid")" 2>/dev/null
  done
  [[ -f $folder/slurmctld.pid ]] || return 0
  local controller k
  controller=$(<"$folder/slurmctld.pid")
  kill "$controller" 2>/dev/null || true
  for ((k = 0; k < 50; ++k)); do
    kill -0 "$controller" 2>/dev/null || return 0
    sleep 0.1
  done
  kill -KILL "$controller" 2>/dev/null || true
}
trap stop EXIT
# Whether a command succeeds within so many seconds.
within() {
  local seconds=$1 k
  shift
  for ((k = 0; k < 10 * seconds; ++k)); do
    if "$@" >/dev/null 2>&1; then return; fi
    sleep 0.1
  done
  echo "not within $seconds s: $*" >&2
  tail -n 20 "$folder"/*.log >&2
  return 1
}
slurmctld
within 20 scontrol ping
for node in n1 n2; do slurmd -N "$node"; done
up() { [[ $(sinfo -h -t idle -o %D) == 2 ]]; }
within 30 up

begin=$(date +%s.%N)
"$hauberk" run "$experiment" -o "$folder/whole" --quiet --threads 1 "$@" >"$folder/whole.out"
middle=$(date +%s.%N)
"$hauberk" submit "$experiment" --engine slurm --array "$parts" -o "$folder/out" "$@"
logs() { find "$folder/out/parts" -name 'searches-*.log' | wc -l; }
half() { (($(logs) * 2 >= parts)); }
within 600 half
echo "killing node n2 with $(logs) of $parts parts begun: $(squeue -h -t R -o '%i on %N' | tr '\n' ';')"
daemon=$(<"$folder/slurmd-n2.pid")
below() {
  local child
  for child in $(pgrep -P "$1" || true); do
    echo "$child"
    below "$child"
  done
}
victims=()
for process in $(pgrep slurmstepd || true); do
  # A job of n2 is below it.
  for job in $(below "$process"); do
    grep -qz '^SLURMD_NODENAME=n2' "/proc/$job/environ" 2>/dev/null || continue
    victims+=("$job")
    if [[ ${KILL:-parts} == node ]]; then victims+=("$process"); fi
  done
done
kill -KILL "$daemon" "${victims[@]}" 2>/dev/null || true
sleep 8  # the controller notices
slurmd -N n2
ended() { [[ -z $(squeue -h) ]]; }
within 900 ended
end=$(date +%s.%N)
missing=$(grep -h 'missing' "$folder"/out/parts/*.out || true)
echo "${missing:-no part had to be submitted again}"
for file in "$folder"/whole/*; do
  name=$(basename "$file")
  [[ $name == timings.json ]] || cmp "$file" "$folder/out/$name"
done
"$hauberk" verify "$folder/out/results.json" >"$folder/verify.out"
printf 'equal byte for byte; one run %.1f s, %d parts on two nodes with a kill %.1f s\n' \
  "$(echo "$middle - $begin" | bc)" "$parts" "$(echo "$end - $middle" | bc)"
