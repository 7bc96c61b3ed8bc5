"""A farm that a benchmark or a test starts for itself, and its jobs, through the command."""

import json
import os
import subprocess
import time

# A farm that doesn't start or stop within so many seconds won't.
LIMIT_S = 600


def bytes_of(path):
    with open(path, "rb") as file:
        return file.read()


def serial_picture(command, scene, size, folder):
    """The bytes of the picture that `serial` makes."""
    picture = os.path.join(folder, "serial.exr")
    subprocess.run([command, "render", scene, "--size", size, "--algorithm", "serial", "-q", "-o", picture],
                   check=True)
    return bytes_of(picture)


def ticks_of(process, with_ended_children):
    """CPU time of a process in clock ticks (proc(5)); 0 if it is gone."""
    try:
        with open(f"/proc/{process}/stat", encoding="utf-8") as file:
            fields = file.read().rpartition(")")[2].split()
    except OSError:
        return 0
    return sum(int(field) for field in fields[11:15 if with_ended_children else 13])


class Farm:
    def __init__(self, command, folder, nodes, *options, port=None, address="127.0.0.1"):
        """At a socket in the folder, or at a TCP port of an address, with its key there."""
        self.command = command
        self.endpoint = "ipc://" + os.path.join(folder, f"farm-{nodes}")
        self.address = ["--connect", self.endpoint]
        if port is not None:
            self.endpoint = f"tcp://{address}:{port}"
            key = os.path.join(folder, "key")
            self.address = ["--connect", self.endpoint, "--key", key]
            options = (*options, "--key", key)
        self.up = subprocess.Popen(
            [command, "up", "-n", str(nodes), "--listen", self.endpoint, *options],
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        until = time.monotonic() + LIMIT_S
        while self.run("status", "--farm", may_fail=True) is None:
            if time.monotonic() > until:
                raise SystemExit("the farm does not start")
            time.sleep(0.1)

    def run(self, *arguments, may_fail=False):
        done = subprocess.run([self.command, *arguments, *self.address],
                              capture_output=True, text=True, check=False)
        if done.returncode != 0 and not may_fail:
            raise SystemExit(" ".join(arguments) + ": " + done.stderr)
        return done.stdout if done.returncode == 0 else None

    def json(self, *arguments):
        return json.loads(self.run(*arguments, "--json"))

    def cpu_s(self):
        """CPU seconds that the frontal and all nodes have taken so far, those that are dead, too."""
        frontal = ticks_of(self.json("status", "--farm")["pid"], True)
        nodes = {node["pid"] for node in self.json("nodes")} - {0}
        return (frontal + sum(ticks_of(node, True) for node in nodes)) / os.sysconf("SC_CLK_TCK")

    def down(self):
        self.run("down")
        self.up.wait(timeout=LIMIT_S)


class Job:
    """A job that is waited for, and what becomes of it."""

    def __init__(self, farm, scene, size, algorithm, folder):
        self.farm = farm
        self.picture = os.path.join(folder, "a.exr")
        self.stats = os.path.join(folder, "a.json")
        self.process = subprocess.Popen(
            [farm.command, "submit", scene, "--size", size, "--algorithm", algorithm,
             "--wait", "-q", "-o", self.picture, "--stats", self.stats, *farm.address],
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.number = self.process.stdout.readline().strip()

    def wait_until_under_way(self, fraction=0.0):
        """Waits until so much of it is done, or it has ended."""
        while True:
            info = self.farm.json("status", self.number)
            is_on = info["state"] not in ("queued", "loading", "building")
            if is_on and (info["state"] != "rendering" or info["fraction"] >= fraction):
                return
            time.sleep(0.01)

    def end(self):
        """Its picture's bytes (None if it has none), what it said, and its statistics."""
        error = self.process.communicate(timeout=LIMIT_S)[1].strip()
        if self.process.returncode != 0:
            return {"bytes": None, "error": error, "stats": {}}
        with open(self.stats, encoding="utf-8") as file:
            return {"bytes": bytes_of(self.picture), "error": error, "stats": json.load(file)}
