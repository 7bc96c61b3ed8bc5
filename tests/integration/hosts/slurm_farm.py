"""slurm_farm.py GRAYCUBE SCENE

Farms of an ordinary user on a real Slurm cluster of four hosts, each in a network namespace of its own:
`render` in a batch job, ended before its time and queued again; `up` in a job, whose nodes and frontal
are killed and one of whose hosts is cut off; `scancel`. Ends with status 77 where Slurm or the right to
make namespaces is missing.
"""

import json
import os
import pwd
import shutil
import subprocess
import sys
import tempfile

from checking import Failed, expect, wait_until
from network import Network, enter_own_namespace, is_running, kill
from slurm_cluster import Cluster

HOSTS, NODES = 4, 8
SIZE = "1000x1000"
PROGRAMS = ("graycube", "graycube-frontal", "graycube-node", "graycube-fifo")
USER = "nobody"


def content(path):
    with open(path, "rb") as file:
        return file.read()


class Test:
    def __init__(self, command, scene, folder):
        self.folder = folder
        os.chmod(folder, 0o755)
        self.home = os.path.join(folder, "home")
        os.mkdir(self.home)
        user = pwd.getpwnam(USER)
        self.ids = ["--reuid", str(user.pw_uid), "--regid", str(user.pw_gid), "--clear-groups"]
        os.chown(self.home, user.pw_uid, user.pw_gid)
        programs = os.path.join(folder, "bin")
        os.mkdir(programs)
        for program in PROGRAMS:
            shutil.copy(os.path.join(os.path.dirname(command), program), programs)
        self.command = os.path.join(programs, "graycube")
        self.scene = os.path.join(folder, "scene.json")
        shutil.copy(scene, self.scene)
        self.network = Network(HOSTS)
        self.cluster = None

    def run(self, *words, may_fail=False):
        """As the user, who has nothing of root's environment; returns standard output."""
        environment = {"HOME": self.home, "PATH": os.environ["PATH"], "SLURM_CONF": os.environ["SLURM_CONF"]}
        done = subprocess.run(["setpriv", *self.ids, *words], capture_output=True, text=True, check=False,
                              env=environment, cwd=self.home)
        if done.returncode != 0 and not may_fail:
            raise Failed(" ".join(words) + ": " + done.stderr)
        return done.stdout if done.returncode == 0 else None

    def path(self, name):
        return os.path.join(self.home, name)

    def submit(self, name, line):
        """Submits a batch script on all hosts; returns the job's number."""
        script = self.path(name + ".sbatch")
        with open(script, "w", encoding="utf-8") as file:
            file.write(f"#!/bin/sh\n#SBATCH --nodes={HOSTS} --ntasks-per-node=1 --cpus-per-task=2 --no-kill\n"
                       f"#SBATCH --job-name={name} --output={self.path(name)}.log --open-mode=append\n"
                       f"exec {line}\n")
        return self.run("sbatch", "--parsable", script).strip()

    def is_queued(self, job):
        return bool((self.run("squeue", "-h", "-j", job, "-o", "%T", may_fail=True) or "").strip())

    def wait_for_end(self, job):
        wait_until(lambda: not self.is_queued(job), f"the end of job {job}")

    def processes(self):
        """Those of the user's farms."""
        done = subprocess.run(["pgrep", "-f", self.folder + "/bin/graycube"], capture_output=True, text=True, check=False)
        return [int(pid) for pid in done.stdout.split()]

    def render_line(self, out):
        return f"{self.command} render {self.scene} --algorithm macro -n {NODES} --size {SIZE} -o {self.path(out)}"

    def check_batch(self):
        job = self.submit("batch", self.render_line("batch.exr") + f" --stats {self.path('batch.json')}")
        self.wait_for_end(job)
        expect(os.path.exists(self.path("batch.exr")), "a batch job renders: " + self.log("batch"))
        expect(content(self.path("batch.exr")) == self.expected, "with serial's bytes")
        with open(self.path("batch.json"), encoding="utf-8") as file:
            expect(json.load(file)["nodes"] == NODES, f"on {NODES} nodes")
        wait_until(lambda: not self.processes(), "nothing is left of the batch job", 20)

    def log(self, name):
        try:
            return content(self.path(name + ".log")).decode(errors="replace").strip()
        except FileNotFoundError:
            return ""

    def check_requeue(self):
        line = self.render_line("again.exr").replace(SIZE, "2400x2400")
        job = self.submit("again", line + f" --stats {self.path('again.json')}")
        checkpoint = self.path("again.exr.checkpoint")
        wait_until(lambda: os.path.exists(checkpoint) and os.path.getsize(checkpoint) > 200000, "tiles are recorded")
        self.run("scancel", "--batch", "--signal=TERM", job)
        self.wait_for_end(job)
        expect(not os.path.exists(self.path("again.exr")) and os.path.exists(checkpoint),
               "a job that is asked to end leaves its tiles: " + self.log("again"))
        job = self.submit("again", line + f" --stats {self.path('again.json')}")
        self.wait_for_end(job)
        with open(self.path("again.json"), encoding="utf-8") as file:
            resumed = json.load(file)["resumed_tiles"]
        expect(resumed > 0, f"queued again it goes on: {resumed} tiles weren't traced again")
        serial = self.path("again-serial.exr")
        self.run(self.command, "render", self.scene, "--size", "2400x2400", "--algorithm", "serial", "-q", "-o", serial)
        expect(content(self.path("again.exr")) == content(serial), "with serial's bytes")

    def client(self, *words, may_fail=False):
        return self.run(self.command, *words, "--connect", f"slurm:{self.farm}", may_fail=may_fail)

    def nodes(self):
        return json.loads(self.client("nodes", "--json"))

    def all_idle(self, count):
        text = self.client("nodes", "--json", may_fail=True)
        states = [node["state"] for node in json.loads(text)] if text else []
        return states == ["idle"] * count

    def check_farm(self):
        self.farm = self.submit("farm", f"{self.command} up -n {NODES} --silence 2 --state {self.path('state')}")
        wait_until(lambda: self.all_idle(NODES), "a farm in a job: " + self.log("farm"))
        self.render_on_farm("a.exr", None)
        killed = self.nodes()[5]["pid"]
        self.render_on_farm("b.exr", lambda: kill(killed))
        wait_until(lambda: self.all_idle(NODES), "another process takes the killed one's place")
        # Not the host on which `up` runs.
        frontal = json.loads(self.client("status", "--farm", "--json"))["pid"]
        cut = self.network.hosts[-1]
        self.render_on_farm("c.exr", cut.cut)
        cut.mend()
        kill(frontal)
        wait_until(lambda: self.client("status", "--farm", may_fail=True) is not None, "another frontal")
        wait_until(lambda: self.all_idle(NODES), "its hosts come back")
        self.render_on_farm("d.exr", None)
        self.run("scancel", self.farm)
        self.wait_for_end(self.farm)
        wait_until(lambda: not self.processes(), "no process is left", 30)
        expect(not os.path.exists(self.path(".graycube/farms/" + self.farm + ".key")), "scancel leaves nothing")

    def render_on_farm(self, out, disturb):
        picture = self.path(out)
        job = self.client("submit", self.scene, "--size", SIZE, "--algorithm", "macro").split()[0]
        if disturb is not None:
            wait_until(lambda: json.loads(self.client("status", job, "--json"))["state"] == "rendering", "a job", 30)
            disturb()
        self.client("watch", job)
        self.client("fetch", job, "-o", picture)
        expect(content(picture) == self.expected, f"{out}: serial's bytes")

    def check(self):
        self.cluster = Cluster(self.network, self.folder)
        serial = self.path("serial.exr")
        self.run(self.command, "render", self.scene, "--size", SIZE, "--algorithm", "serial", "-q", "-o", serial)
        self.expected = content(serial)
        self.check_batch()
        self.check_requeue()
        self.check_farm()

    def close(self):
        if self.cluster is not None:
            self.cluster.close()
        for process in self.processes():
            if is_running(process):
                kill(process)
        self.network.close()


def main():
    enter_own_namespace()
    command, scene = sys.argv[1:]
    # Not below /tmp, which each host has for itself.
    with tempfile.TemporaryDirectory(dir="/var/tmp") as folder:
        test = Test(command, scene, folder)
        try:
            test.check()
        except Failed as failed:
            print(failed, flush=True)
            return 1
        finally:
            test.close()
    return 0


if __name__ == "__main__":
    sys.exit(main())
