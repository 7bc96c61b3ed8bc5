"""joined_farm.py GRAYCUBE SCENE

A farm whose nodes run on four hosts, in network namespaces of their own, which join it by `graycube
join`: pictures have serial's bytes; also when a node is killed, when a host's link is cut while a job is
on, when another host comes, and when the frontal dies. In the end nothing is left. Ends with status 77
where no namespaces can be made.
"""

import os
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "..", "bench"))
from local_farm import Farm, Job, serial_picture  # noqa: E402  (it lies in the folder named above)
from checking import Failed, expect, wait_until  # noqa: E402
from network import Network, enter_own_namespace, is_running, kill  # noqa: E402

PORT = 7411
SIZE = "1000x1000"
NODES, HOSTS, SLOTS = 8, 4, 2


class Joined:
    """`graycube join` on a host."""

    def __init__(self, host, command, endpoint, key):
        self.host = host
        self.process = host.start(
            [command, "join", endpoint, "--key", key, "--slots", str(SLOTS), "--name", host.name],
            stderr=subprocess.PIPE, text=True)

    def end(self, seconds=90):
        """Its status, and what it said."""
        said = self.process.communicate(timeout=seconds)[1]
        return self.process.returncode, said


class Test:
    def __init__(self, command, scene, folder):
        self.command, self.scene, self.folder = command, scene, folder
        # What is killed leaves its folders there.
        os.environ["TMPDIR"] = folder
        self.key = os.path.join(folder, "key")
        # As a shell does it: others may read the file, were it not for the command.
        os.umask(0o022)
        with open(self.key, "wb") as file:
            subprocess.run([command, "key"], check=True, stdout=file)
        expect(os.stat(self.key).st_mode & 0o777 == 0o600, "a key is its owner's alone, whatever the umask")
        self.expected = serial_picture(command, scene, SIZE, folder)
        self.network = Network(HOSTS)
        self.farm = Farm(command, folder, NODES, "--farm", "joined", "--silence", "2",
                         port=PORT, address=self.network.address)
        self.joined = [self.join(host) for host in self.network.hosts]

    def join(self, host):
        return Joined(host, self.command, self.farm.endpoint, self.key)

    def nodes(self):
        return self.farm.json("nodes")

    def nodes_of(self, host):
        return [node for node in self.nodes() if node.get("host") == host.name]

    def wait_for_nodes(self, count):
        wait_until(lambda: [n["state"] for n in self.nodes()].count("idle") == count == len(self.nodes()),
                   f"{count} nodes")

    def render(self, algorithm, disturb=None):
        job = Job(self.farm, self.scene, SIZE, algorithm, self.folder)
        if disturb is not None:
            job.wait_until_under_way(0.02)
            disturb()
        end = job.end()
        expect(end["bytes"] == self.expected,
               f"{algorithm}: serial's bytes " + (end["error"] or ""))
        return end["stats"]

    def check_dealt(self):
        self.wait_for_nodes(NODES)
        for number, host in enumerate(self.network.hosts):
            ranks = sorted(node["rank"] for node in self.nodes_of(host))
            expect(len(ranks) == SLOTS and ranks[1] == ranks[0] + 1,
                   f"host {number + 1} has consecutive ranks {ranks}")

    def check_kill(self):
        killed = self.nodes()[5]["pid"]
        stats = self.render("macro", lambda: kill(killed))
        expect(stats["epochs"] >= 2 and stats["losses"], "the loss of a node is told")
        self.wait_for_nodes(NODES)

    def check_cut(self):
        host = self.network.hosts[2]
        lost = [node["pid"] for node in self.nodes_of(host)]
        stats = self.render("macro", host.cut)
        expect(stats["epochs"] >= 2, "the loss of a host begins another epoch")
        wait_until(lambda: not any(is_running(pid) for pid in lost), "the cut host's nodes end")
        status, said = self.joined[2].end()
        expect(status == 1 and "silent" in said, "the cut host says why it ends")
        self.wait_for_nodes(NODES // 2)
        host.mend()
        self.joined[2] = self.join(host)
        self.check_dealt()
        self.render("roth")

    def check_frontal_death(self):
        kill(self.farm.json("status", "--farm")["pid"])
        wait_until(lambda: self.farm.run("status", "--farm", may_fail=True) is not None, "another frontal")
        self.wait_for_nodes(NODES)
        self.render("macro")

    def check_end(self):
        everyone = [node["pid"] for node in self.nodes()]
        self.farm.down()
        for joined in self.joined:
            status, said = joined.end()
            expect(status == 0, "a host ends in order with the farm " + said.strip().splitlines()[-1])
        expect(not any(is_running(pid) for pid in everyone), "no node is left")

    def check_silence(self):
        """Nobody is left to tell hosts that it is over."""
        self.farm = Farm(self.command, self.folder, NODES, "--farm", "joined", "--silence", "2",
                         port=PORT, address=self.network.address)
        self.joined = [self.join(host) for host in self.network.hosts]
        self.wait_for_nodes(NODES)
        everyone = [node["pid"] for node in self.nodes()]
        frontal = self.farm.json("status", "--farm")["pid"]
        kill(self.farm.up.pid)
        kill(frontal)
        wait_until(lambda: not any(is_running(pid) for pid in everyone), "nodes end", 10)
        for joined in self.joined:
            expect(joined.end()[0] == 1, "a host ends without its frontal")

    def run(self):
        self.check_dealt()
        for algorithm in ("macro", "roth"):
            self.render(algorithm)
        self.check_kill()
        self.check_cut()
        self.check_frontal_death()
        self.check_end()
        self.check_silence()

    def close(self):
        for joined in self.joined:
            joined.process.kill()
        self.farm.up.kill()
        self.network.close()


def main():
    enter_own_namespace()
    command, scene = sys.argv[1:]
    with tempfile.TemporaryDirectory() as folder:
        test = Test(command, scene, folder)
        try:
            test.run()
        except Failed as failed:
            print(failed, flush=True)
            return 1
        finally:
            test.close()
    return 0


if __name__ == "__main__":
    sys.exit(main())
