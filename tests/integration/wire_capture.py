"""wire_capture.py GRAYCUBE SCENE

A farm listens off the loopback in a network namespace of its own, and a client in another one has a
picture rendered there. What goes over the wire between them doesn't hold the scene's text, and has no
pattern at all, as pixels would have; the picture is serial's. Then clients with wrong keys are turned away. Ends with
status 77 where no namespace can be made.
"""

import os
import socket
import subprocess
import sys
import tempfile
import threading
import time
import zlib

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "bench"))
from local_farm import bytes_of, serial_picture  # noqa: E402  (it lies in the folder named above)

SKIPPED = 77
IS_INSIDE = "GRAYCUBE_TEST_NAMESPACE"
FARM, CLIENT = "10.77.1.1", "10.77.1.2"
# Nobody else is in the namespaces, so that any port is free.
ENDPOINT, EVERYWHERE = f"tcp://{FARM}:7411", "tcp://*:7411"
CONTROL_PORT = 7412
SIZE = "160x120"
LIMIT_S = 120
ALL_PROTOCOLS = 3
# Pieces of texts that are looked for: long enough that they don't occur by chance.
PIECE = 24
# Bytes of a frame before what TCP carries, at most; frames whose carriage counts; packed to what part.
HEADERS, LONG_FRAME, PACKED = 100, 400, 0.95


class Wire:
    """Records all that goes through an interface."""

    def __init__(self, interface):
        self.socket = socket.socket(socket.AF_PACKET, socket.SOCK_RAW, socket.htons(ALL_PROTOCOLS))
        self.socket.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 1 << 26)
        self.socket.bind((interface, 0))
        self.frames = []
        threading.Thread(target=self.record, daemon=True).start()

    def record(self):
        try:
            while True:
                self.frames.append(self.socket.recv(1 << 17))
        except OSError:
            pass  # the other end has gone, and the interface with it

    def take(self):
        time.sleep(0.5)
        taken, self.frames = self.frames, []
        return taken

    def holds(self, frames, secret):
        pieces = [secret[i:i + PIECE] for i in range(0, len(secret) - PIECE, 997)]
        pieces += [secret[i:i + PIECE] for i in range(0, min(len(secret), 4096) - PIECE, PIECE)]
        pieces = [p for p in pieces if len(set(p)) > 6]
        return any(piece in frame for frame in frames for piece in pieces)

    @staticmethod
    def has_patterns(frames):
        """Whether what long frames carry can be packed: what is encrypted can't."""
        carried = b"".join(frame[HEADERS:] for frame in frames if len(frame) > LONG_FRAME)
        return len(zlib.compress(carried)) < PACKED * len(carried)


class Client:
    """A namespace with the other end of a wire."""

    def __init__(self):
        self.keeper = subprocess.Popen(["unshare", "-n", "sleep", "3600"])
        time.sleep(0.2)
        run("ip", "link", "add", "farm", "type", "veth", "peer", "name", "client")
        run("ip", "link", "set", "client", "netns", str(self.keeper.pid))
        run("ip", "address", "add", f"{FARM}/24", "dev", "farm")
        run("ip", "link", "set", "farm", "up")
        run("ip", "link", "set", "lo", "up")
        self.do("ip", "address", "add", f"{CLIENT}/24", "dev", "client")
        self.do("ip", "link", "set", "client", "up")

    def do(self, *command, check=True):
        return subprocess.run(["nsenter", f"--net=/proc/{self.keeper.pid}/ns/net", *command],
                              capture_output=True, text=True, check=check, timeout=LIMIT_S)

    def end(self):
        self.keeper.kill()
        self.keeper.wait()


def run(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def make_key(command, folder, name, *options):
    path = os.path.join(folder, name)
    with open(os.open(path, os.O_WRONLY | os.O_CREAT, 0o600), "w", encoding="ascii") as file:
        file.write(run(command, "key", *options))
    return path


def control(wire, client, secret):
    """What goes in clear is seen."""
    with socket.create_server((FARM, CONTROL_PORT)) as server:
        program = f"import socket,sys; socket.create_connection(('{FARM}', {CONTROL_PORT})).sendall(open(sys.argv[1],'rb').read())"
        client.do(sys.executable, "-c", program, secret)
        server.accept()[0].close()
    frames = wire.take()
    return wire.holds(frames, bytes_of(secret)) and wire.has_patterns(frames)


def check(command, scene, folder, client):
    expected = serial_picture(command, scene, SIZE, folder)
    key, other = make_key(command, folder, "key"), make_key(command, folder, "other")
    own = make_key(command, folder, "client", "--client", key)
    wire = Wire("farm")
    problems = []
    if not control(wire, client, scene):
        problems.append("the scene in clear isn't seen on the wire")
    log = os.path.join(folder, "log")
    farm = subprocess.Popen([command, "up", "-n", "4", "--listen", EVERYWHERE, "--key", key, "--log", log],
                            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        address = ["--connect", ENDPOINT, "--key", own]
        until = time.monotonic() + LIMIT_S
        while client.do(command, "nodes", *address, check=False).returncode != 0:
            if time.monotonic() > until:
                return ["the farm does not start"]
        picture = os.path.join(folder, "a.exr")
        done = client.do(command, "submit", scene, "--size", SIZE, "--algorithm", "macro", "--wait", "-q",
                         "-o", picture, *address, check=False)
        frames = wire.take()
        if done.returncode != 0 or bytes_of(picture) != expected:
            problems.append(done.stderr or "the picture differs")
        if sum(map(len, frames)) < len(expected):
            problems.append("the wire was not recorded")
        if wire.holds(frames, bytes_of(scene)) or wire.has_patterns(frames):
            problems.append("what goes over the wire can be read")
        problems += refusals(command, client, other)
        client.do(command, "down", *address)
        farm.wait(timeout=LIMIT_S)
        if "without the farm's key" not in bytes_of(log).decode():
            problems.append("the log doesn't tell who was turned away")
    finally:
        farm.terminate()
        farm.wait(timeout=LIMIT_S)
    return problems


def refusals(command, client, other):
    problems = []
    for arguments, sentence in (
            (["--connect", ENDPOINT, "--key", other], "it is another farm than this key's, or none"),
            (["--connect", ENDPOINT], "need a key: --key FILE"),
            (["--connect", f"tcp://{FARM}:7999", "--key", other], "nobody answers")):
        done = client.do(command, "nodes", *arguments, check=False)
        if done.returncode == 0 or sentence not in done.stderr:
            problems.append(f"{arguments}: {done.stderr or 'let in'}")
    return problems


def main():
    if IS_INSIDE not in os.environ:
        if subprocess.run(["unshare", "-n", "true"], check=False, stderr=subprocess.DEVNULL).returncode != 0:
            print("skipped: only root can make a network namespace")
            return SKIPPED
        os.environ[IS_INSIDE] = "1"
        os.execvp("unshare", ["unshare", "-n", sys.executable, "-B", *sys.argv])
    command, scene = sys.argv[1:]
    client = Client()
    try:
        with tempfile.TemporaryDirectory() as folder:
            problems = check(command, scene, folder, client)
    finally:
        client.end()
    print("\n".join(problems) or "nothing can be read on the wire", flush=True)
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
