"""cut_loopback.py GRAYCUBE SCENE

A farm listens at a TCP port of a network namespace of its own, whose loopback goes down while a
client waits for its job, and up again: the client must end well, with serial's bytes. The nodes'
links are local sockets, which that doesn't touch. Ends with status 77 where no namespace can be
made.
"""

import fcntl
import os
import socket
import struct
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "bench"))
from local_farm import Farm, Job, serial_picture  # noqa: E402  (it lies in the folder named above)

SKIPPED = 77
IS_INSIDE = "GRAYCUBE_TEST_NAMESPACE"
# Of linux/sockios.h and linux/if.h.
SIOCGIFFLAGS, SIOCSIFFLAGS, IFF_UP = 0x8913, 0x8914, 1
# Nobody else is in the namespace, so that any port is free.
PORT = 7123
SIZE = "1200x1200"
DOWN_S = 1.0


def set_loopback(is_up):
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as any_socket:
        request = struct.pack("16sh14x", b"lo", 0)
        flags = struct.unpack("16sh14x", fcntl.ioctl(any_socket, SIOCGIFFLAGS, request))[1]
        flags = flags | IFF_UP if is_up else flags & ~IFF_UP
        fcntl.ioctl(any_socket, SIOCSIFFLAGS, struct.pack("16sh14x", b"lo", flags))


def is_reachable():
    try:
        with socket.create_connection(("127.0.0.1", PORT), timeout=0.2):
            return True
    except OSError:
        return False


def check(command, scene, algorithm, folder, expected):
    farm = Farm(command, folder, 4, port=PORT)
    job = Job(farm, scene, SIZE, algorithm, folder)
    job.wait_until_under_way(0.02)
    state = farm.json("status", job.number)["state"]
    set_loopback(False)
    was_cut = not is_reachable()
    time.sleep(DOWN_S)
    set_loopback(True)
    end = job.end()
    farm.down()
    problems = []
    if state != "rendering" or not was_cut:
        problems.append(f"the link was not cut while the job was on ({state})")
    if end["bytes"] != expected:
        problems.append(end["error"] or "the picture differs")
    print(f"{algorithm}: " + ("; ".join(problems) or "the picture is right"), flush=True)
    return not problems


def main():
    if IS_INSIDE not in os.environ:
        if subprocess.run(["unshare", "-n", "true"], check=False, stderr=subprocess.DEVNULL).returncode != 0:
            print("skipped: only root can make a network namespace")
            return SKIPPED
        os.environ[IS_INSIDE] = "1"
        os.execvp("unshare", ["unshare", "-n", sys.executable, "-B", *sys.argv])
    command, scene = sys.argv[1:]
    set_loopback(True)
    with tempfile.TemporaryDirectory() as folder:
        expected = serial_picture(command, scene, SIZE, folder)
        results = [check(command, scene, algorithm, folder, expected) for algorithm in ("macro", "roth")]
    return 0 if all(results) else 1


if __name__ == "__main__":
    sys.exit(main())
