"""A farm that a benchmark starts for itself, and asks through the command."""

import json
import os
import subprocess
import time

# A farm that doesn't start or stop within so many seconds won't.
LIMIT_S = 600


class Farm:
    def __init__(self, command, folder, nodes, *options):
        self.command = command
        self.endpoint = "ipc://" + os.path.join(folder, f"farm-{nodes}")
        self.up = subprocess.Popen(
            [command, "up", "-n", str(nodes), "--listen", self.endpoint, *options],
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        until = time.monotonic() + LIMIT_S
        while self.run("status", "--farm", may_fail=True) is None:
            if time.monotonic() > until:
                raise SystemExit("the farm does not start")
            time.sleep(0.1)

    def run(self, *arguments, may_fail=False):
        done = subprocess.run([self.command, *arguments, "--connect", self.endpoint],
                              capture_output=True, text=True, check=False)
        if done.returncode != 0 and not may_fail:
            raise SystemExit(" ".join(arguments) + ": " + done.stderr)
        return done.stdout if done.returncode == 0 else None

    def json(self, *arguments):
        return json.loads(self.run(*arguments, "--json"))

    def down(self):
        self.run("down")
        self.up.wait(timeout=LIMIT_S)
