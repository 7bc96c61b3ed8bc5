"""A network of hosts on this machine, for tests of farms across machines: network namespaces over a bridge.

All of it lies in a namespace of its own, and goes with the process that made it.
"""

import os
import signal
import subprocess
import sys

SKIPPED = 77
IS_INSIDE = "GRAYCUBE_TEST_NAMESPACE"
BRIDGE = "farm"
# Documentation's addresses (RFC 5737): whatever happens, they are nobody's.
PREFIX = "192.0.2."
FIRST = 254


def skip(why):
    print("skipped: " + why, flush=True)
    sys.exit(SKIPPED)


def enter_own_namespace():
    """Goes on in a network and mount namespace of its own; skips the test where that can't be."""
    if IS_INSIDE in os.environ:
        return
    if subprocess.run(["unshare", "-n", "-m", "true"], check=False, stderr=subprocess.DEVNULL).returncode != 0:
        skip("only root can make a network namespace")
    if subprocess.run(["ip", "-V"], check=False, capture_output=True).returncode != 0:
        skip("there is no command ip")
    os.environ[IS_INSIDE] = "1"
    os.execvp("unshare", ["unshare", "-n", "-m", sys.executable, "-B", *sys.argv])


def ip(*words):
    subprocess.run(["ip", *words], check=True)


class Host:
    """A namespace that is reached at an address over the bridge."""

    def __init__(self, number):
        self.name = f"host{number}"
        self.address = PREFIX + str(number)
        self.port = f"to{number}"
        # It holds the namespaces, which go with it. Files are the machine's own, but what the host puts
        # below /dev/shm no other sees; so hosts have different mount namespaces, as machines do.
        self.holder = subprocess.Popen(
            ["unshare", "-n", "-m", "-u", "sh", "-c", f"hostname {self.name}; echo; exec sleep infinity"],
            stdout=subprocess.PIPE)
        self.holder.stdout.readline()
        ip("link", "add", self.port, "type", "veth", "peer", "name", "eth0", "netns", str(self.holder.pid))
        ip("link", "set", self.port, "master", BRIDGE, "up")
        for words in (["addr", "add", self.address + "/24", "dev", "eth0"],
                      ["link", "set", "eth0", "up"], ["link", "set", "lo", "up"]):
            self.run(["ip", *words])

    def inside(self, command):
        return ["nsenter", "-t", str(self.holder.pid), "-n", "-m", "-u", "--", *command]

    def run(self, command):
        subprocess.run(self.inside(command), check=True)

    def start(self, command, **how):
        return subprocess.Popen(self.inside(command), **how)

    def cut(self):
        ip("link", "set", self.port, "down")

    def mend(self):
        ip("link", "set", self.port, "up")


class Network:
    """A bridge, at which this process has an address, and hosts."""

    def __init__(self, hosts):
        self.address = PREFIX + str(FIRST)
        ip("link", "add", BRIDGE, "type", "bridge")
        ip("addr", "add", self.address + "/24", "dev", BRIDGE)
        ip("link", "set", BRIDGE, "up")
        ip("link", "set", "lo", "up")
        self.hosts = [Host(number + 1) for number in range(hosts)]

    def close(self):
        for host in self.hosts:
            host.holder.kill()
            host.holder.wait()
        subprocess.run(["ip", "link", "del", BRIDGE], check=False)


def is_running(process_id):
    try:
        os.kill(process_id, 0)
    except ProcessLookupError:
        return False
    with open(f"/proc/{process_id}/stat", encoding="utf-8") as file:
        return file.read().rpartition(")")[2].split()[0] != "Z"


def kill(process_id):
    try:
        os.kill(process_id, signal.SIGKILL)
    except ProcessLookupError:
        pass
