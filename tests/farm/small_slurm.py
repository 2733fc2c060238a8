"""A Slurm of one node, from Debian's packages, without systemd; all of its state is in one folder."""

import getpass
import os
import shutil
import signal
import socket
import subprocess
import time

PROGRAMS = ("munged", "slurmctld", "slurmd", "sbatch", "scontrol", "squeue")
PLACES = os.environ.get("PATH", "") + ":/usr/sbin:/sbin"


def lacks():
    """The programs that are not installed."""
    return [name for name in PROGRAMS if not shutil.which(name, path=PLACES)]


def free_ports(count):
    sockets = [socket.socket() for _ in range(count)]
    for each in sockets:
        each.bind(("127.0.0.1", 0))
    ports = [each.getsockname()[1] for each in sockets]
    for each in sockets:
        each.close()
    return ports


class SmallSlurm:
    def __init__(self, folder, processors=2):
        self.folder = folder
        self.daemons = []
        self.host = socket.gethostname().split(".")[0]
        self.node = "node1"
        os.makedirs(self.path("state"))
        os.makedirs(self.path("spool"))
        with open(self.path("munge.key"), "wb") as key:
            key.write(os.urandom(128))
        os.chmod(self.path("munge.key"), 0o400)
        self.write_configuration(processors)
        self.environment = dict(os.environ, SLURM_CONF=self.path("slurm.conf"), PATH=PLACES)

    def path(self, name):
        return os.path.join(self.folder, name)

    def write_configuration(self, processors):
        ctld_port, slurmd_port = free_ports(2)
        settings = {
            "ClusterName": "small",
            "SlurmctldHost": f"{self.host}(127.0.0.1)",
            "SlurmUser": getpass.getuser(),
            "SlurmdUser": getpass.getuser(),
            "SlurmctldPort": ctld_port,
            "SlurmdPort": slurmd_port,
            # A job that is queued again waits until its old credentials are void: seconds here, two minutes else.
            "AuthInfo": f"socket={self.path('munge.socket')},cred_expire=5",
            "AuthType": "auth/munge",
            "CredType": "cred/munge",
            "StateSaveLocation": self.path("state"),
            "SlurmdSpoolDir": self.path("spool"),
            "SlurmctldPidFile": self.path("slurmctld.pid"),
            "SlurmdPidFile": self.path("slurmd.pid"),
            "ProctrackType": "proctrack/linuxproc",
            "TaskPlugin": "task/none",
            "SelectType": "select/cons_tres",
            "SelectTypeParameters": "CR_CPU",
            "SchedulerParameters": "sched_interval=1,bf_interval=1,batch_sched_delay=0",
            "MinJobAge": 300,
            "KillWait": 5,
            "ReturnToService": 2,
            "MpiDefault": "none",
            "SwitchType": "switch/none",
            "JobAcctGatherType": "jobacct_gather/none",
            "AccountingStorageType": "accounting_storage/none",
        }
        with open(self.path("slurm.conf"), "w", encoding="utf-8") as file:
            file.writelines(f"{name}={value}\n" for name, value in settings.items())
            file.write(f"NodeName={self.node} NodeHostname={self.host} NodeAddr=127.0.0.1 CPUs={processors} State=UNKNOWN\n")
            file.write(f"PartitionName=all Nodes={self.node} Default=YES MaxTime=INFINITE State=UP\n")

    def start_daemon(self, name, *arguments):
        log = open(self.path(f"{name}.out"), "wb")  # kept open by the daemon
        self.daemons.append(subprocess.Popen([shutil.which(name, path=PLACES), *arguments], env=self.environment,
                                             stdout=log, stderr=log, stdin=subprocess.DEVNULL))
        log.close()

    def start(self):
        self.start_daemon("munged", "--foreground", "--force", f"--key-file={self.path('munge.key')}",
                          f"--socket={self.path('munge.socket')}", f"--pid-file={self.path('munged.pid')}",
                          f"--log-file={self.path('munged.log')}", f"--seed-file={self.path('munged.seed')}")
        self.wait_for(lambda: os.path.exists(self.path("munge.socket")), "munged")
        self.start_daemon("slurmctld", "-D", "-f", self.path("slurm.conf"))
        self.start_daemon("slurmd", "-D", "-f", self.path("slurm.conf"), "-N", self.node)
        self.wait_for(lambda: "idle" in self.run("sinfo", "-h", "-o", "%t").stdout, "an idle node")

    def run(self, *command, **more):
        return subprocess.run(command, env=self.environment, capture_output=True, text=True, timeout=120, **more)

    def wait_for(self, is_so, what, seconds=60):
        give_up = time.monotonic() + seconds
        while not is_so():
            for daemon in self.daemons:
                if daemon.poll() is not None:
                    raise RuntimeError(f"{daemon.args[0]} ended\n{self.logs()}")
            if time.monotonic() > give_up:
                raise RuntimeError(f"waited {seconds} s for {what}\n{self.run('squeue').stdout}\n{self.logs()}")
            time.sleep(0.1)

    def logs(self):
        texts = []
        for name in ("munged.out", "munged.log", "slurmctld.out", "slurmd.out"):
            if os.path.exists(self.path(name)):
                with open(self.path(name), encoding="utf-8", errors="replace") as file:
                    texts.append(f"--- {name}\n" + "".join(file.readlines()[-15:]))
        return "\n".join(texts)

    def is_empty(self):
        listed = self.run("squeue", "-h")
        return listed.returncode == 0 and not listed.stdout.strip()

    def stop(self):
        self.run("scancel", "-u", getpass.getuser())
        for daemon in reversed(self.daemons):
            daemon.send_signal(signal.SIGTERM)
        for daemon in reversed(self.daemons):
            try:
                daemon.wait(timeout=20)
            except subprocess.TimeoutExpired:
                daemon.kill()
                daemon.wait()
