"""joined_cost.py GRAYCUBE SCENE [--nodes N] [--size WxH] [--pairs P]

What it costs that nodes run on hosts: CPU time of a job on a farm whose hosts are one machine (their links
are local sockets), and on one whose hosts don't know that they are (all links between them are TCP with
CURVE), over that of the same job on a farm that runs its nodes itself. Jobs take turns; medians of the
ratios, with quartiles. The last farm's hosts need mount namespaces of their own, so root.
"""

import argparse
import os
import statistics
import subprocess
import tempfile
import time

from local_farm import Farm, Job

HOSTS = 2


class Hosts:
    """A farm and the hosts that have joined it."""

    def __init__(self, options, folder, port, before):
        os.mkdir(folder)
        self.folder = folder
        self.farm = Farm(options.graycube, folder, options.nodes, "--farm", "joined", port=port)
        self.joined = [
            subprocess.Popen([*before, options.graycube, "join", self.farm.endpoint, "--key", os.path.join(folder, "key"),
                              "--slots", str(options.nodes // HOSTS)], stderr=subprocess.DEVNULL)
            for _ in range(HOSTS)]
        while [node["state"] for node in self.farm.json("nodes")].count("idle") < options.nodes:
            time.sleep(0.1)


class Local:
    def __init__(self, options, folder):
        os.mkdir(folder)
        self.folder = folder
        self.farm = Farm(options.graycube, folder, options.nodes)


def cpu_of_job(at, options):
    before = at.farm.cpu_s()
    end = Job(at.farm, options.scene, options.size, "macro", at.folder).end()
    if end["bytes"] is None:
        raise SystemExit(end["error"])
    return at.farm.cpu_s() - before, end["bytes"], end["stats"]["messages"]["ray_bytes"] / 1e6


def told(name, ratios):
    low, middle, high = statistics.quantiles(ratios, n=4)
    print(f"{name}: {middle:.3f} ({low:.3f} to {high:.3f})", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("graycube")
    parser.add_argument("scene")
    parser.add_argument("--nodes", type=int, default=8)
    parser.add_argument("--size", default="512x512")
    parser.add_argument("--pairs", type=int, default=9)
    parser.add_argument("--port", type=int, default=7421)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        farms = {"local": Local(options, os.path.join(folder, "a")),
                 "joined, local sockets": Hosts(options, os.path.join(folder, "b"), options.port, []),
                 "joined, TCP with CURVE": Hosts(options, os.path.join(folder, "c"), options.port + 1, ["unshare", "-m"])}
        for at in farms.values():  # the first job of a farm makes its memory
            cpu_of_job(at, options)
        ratios = {name: [] for name in farms if name != "local"}
        for _ in range(options.pairs):
            cpu_s, picture, megabytes = cpu_of_job(farms["local"], options)
            for name, of in ratios.items():
                other_s, other, megabytes = cpu_of_job(farms[name], options)
                if other != picture:
                    raise SystemExit(name + ": another picture")
                of.append(other_s / cpu_s)
        print(f"{options.nodes} nodes on {HOSTS} hosts, {options.size}, local {cpu_s:.2f} s of CPU, {megabytes:.1f} MB of rays")
        for name, of in ratios.items():
            told(name, of)
        for at in farms.values():
            at.farm.down()


if __name__ == "__main__":
    main()
