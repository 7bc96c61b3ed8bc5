"""A real Slurm cluster on this machine, for tests: a slurmd in each host of a network (network.py).

Hosts have four CPUs each, as far as Slurm knows, and a /tmp of their own, since files that all shared would
hide mistakes. What jobs share lies in the cluster's folder.
"""

import os
import shutil
import subprocess
import time

from network import skip

CPUS = 4
PROGRAMS = ("munged", "slurmctld", "slurmd", "srun", "sbatch", "scancel", "squeue", "sinfo", "scontrol")
# Seconds until Slurm takes a host that doesn't answer for lost.
HOST_TIMEOUT_S = 10

CONFIGURATION = """ClusterName=test
SlurmctldHost={controller}({address})
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket={folder}/munge/socket/socket
CredType=cred/munge
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool/%n
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/%n.pid
SlurmctldLogFile={folder}/log/slurmctld
SlurmdLogFile={folder}/log/%n
SlurmctldPort=16817
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
ReturnToService=2
SlurmdTimeout={timeout}
SlurmctldTimeout={timeout}
KillWait=3
UnkillableStepTimeout=60
SwitchType=switch/none
JobCompType=jobcomp/none
AccountingStorageType=accounting_storage/none
JobRequeue=1
SlurmdParameters=config_overrides
TreeWidth=65533
{nodes}
PartitionName=main Nodes=ALL Default=YES MaxTime=INFINITE State=UP
"""


class Cluster:
    def __init__(self, network, folder):
        """`folder`: of the cluster and of what its jobs share; not below /tmp."""
        missing = [program for program in PROGRAMS if shutil.which(program) is None]
        if missing:
            skip("no Slurm here: " + ", ".join(missing))
        self.network, self.folder = network, folder
        for name in ("state", "spool", "log", "munge", "munge/private", "munge/socket"):
            os.makedirs(os.path.join(folder, name), exist_ok=True)
        os.chmod(os.path.join(folder, "munge", "private"), 0o700)
        self.daemons = []
        self.hosts_file()
        self.munge()
        self.configure()
        self.start()

    def hosts_file(self):
        """Names of all hosts, for this namespace and theirs."""
        self.controller = os.uname().nodename
        path = os.path.join(self.folder, "hosts")
        with open(path, "w", encoding="utf-8") as file:
            print("127.0.0.1 localhost", file=file)
            print(self.network.address, self.controller, file=file)
            for host in self.network.hosts:
                print(host.address, host.name, file=file)
        subprocess.run(["mount", "--bind", path, "/etc/hosts"], check=True)
        for host in self.network.hosts:
            host.run(["mount", "--bind", path, "/etc/hosts"])
            host.run(["mount", "-t", "tmpfs", "none", "/tmp"])

    def munge(self):
        private = os.path.join(self.folder, "munge", "private")
        with open(os.open(os.path.join(private, "key"), os.O_WRONLY | os.O_CREAT, 0o400), "wb") as file:
            file.write(os.urandom(128))
        self.begin(["munged", "--foreground", "--force", "--key-file=" + private + "/key",
                    "--socket=" + os.path.join(self.folder, "munge/socket/socket"),
                    "--pid-file=" + private + "/pid", "--log-file=" + private + "/log",
                    "--seed-file=" + private + "/seed"])

    def configure(self):
        nodes = "\n".join(f"NodeName={host.name} NodeAddr={host.address} Port=16818 CPUs={CPUS} RealMemory=1000"
                          for host in self.network.hosts)
        path = os.path.join(self.folder, "slurm.conf")
        with open(path, "w", encoding="utf-8") as file:
            file.write(CONFIGURATION.format(controller=self.controller, address=self.network.address,
                                            folder=self.folder, timeout=HOST_TIMEOUT_S, nodes=nodes))
        os.environ["SLURM_CONF"] = path

    def begin(self, command, host=None):
        start = host.start if host is not None else subprocess.Popen
        self.daemons.append(start(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL))

    def start(self):
        self.begin(["slurmctld", "-D", "-c"])
        for host in self.network.hosts:
            os.makedirs(os.path.join(self.folder, "spool", host.name), exist_ok=True)
            self.begin(["slurmd", "-D", "-N", host.name], host)
        until = time.monotonic() + 60
        while self.states().count("idle") < len(self.network.hosts):
            if time.monotonic() > until:
                raise RuntimeError("the cluster doesn't come up: " + " ".join(self.states()))
            time.sleep(0.2)

    def states(self):
        """What Slurm thinks of each host."""
        done = subprocess.run(["sinfo", "-h", "-N", "-o", "%T"], capture_output=True, text=True, check=False)
        return done.stdout.split()

    def close(self):
        for daemon in reversed(self.daemons):
            daemon.terminate()
        for daemon in self.daemons:
            try:
                daemon.wait(timeout=10)
            except subprocess.TimeoutExpired:
                daemon.kill()
                daemon.wait()
