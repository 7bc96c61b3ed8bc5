"""torture.py GRAYCUBE SCENE [--faults N] [--kinds kill,stop,cont] [--nodes 8,16]
                             [--algorithms macro,roth] [--size WxH] [--seed S] [--faults-a-job K]
                             [--usual N]

Kills (kill), stops (stop), or stops for a while and lets go on (cont) random nodes of a farm at
random moments of jobs, and looks whether every picture equals serial's. Prints, for each kind,
algorithm and number of nodes, how many pictures were right, how long after the fault its loss was
noticed (by another process's id in `graycube nodes`), and the CPU of jobs with one loss by that of
jobs without, of which N come first. Ends with status 1 if a picture was wrong.
"""

import argparse
import collections
import json
import os
import random
import signal
import statistics
import sys
import tempfile
import time

from local_farm import Farm, Job, serial_picture

# A fault is noticed late if at all after so long.
NOTICE_LIMIT_S = 30


def strike(farm, kind, chance):
    """Brings a fault upon a random node; returns the seconds until it was noticed, if it was."""
    node = chance.choice([n for n in farm.json("nodes") if n["pid"] != 0])
    try:
        os.kill(node["pid"], signal.SIGKILL if kind == "kill" else signal.SIGSTOP)
    except ProcessLookupError:
        return None
    began = time.monotonic()
    if kind == "cont":
        time.sleep(chance.uniform(0, 4))
        try:
            os.kill(node["pid"], signal.SIGCONT)
        except ProcessLookupError:
            pass
        return None
    while time.monotonic() - began < NOTICE_LIMIT_S:
        if farm.json("nodes")[node["rank"]]["pid"] != node["pid"]:
            return time.monotonic() - began
        time.sleep(0.002)
    return None


def usual(farm, options, algorithm, folder):
    """Seconds and CPU seconds of jobs without faults: medians."""
    jobs = []
    for _ in range(options.usual):
        began, cpu_s = time.monotonic(), farm.cpu_s()
        Job(farm, options.scene, options.size, algorithm, folder).end()
        jobs.append((time.monotonic() - began, farm.cpu_s() - cpu_s))
    return [statistics.median(column) for column in zip(*jobs)]


def torture(farm, options, kind, algorithm, folder, expected, chance):
    takes_s, cpu_s = usual(farm, options, algorithm, folder)
    tally = collections.Counter()
    noticed, cpu = [], []
    for _ in range(options.faults):
        cpu_before_s = farm.cpu_s()
        job = Job(farm, options.scene, options.size, algorithm, folder)
        job.wait_until_under_way()
        for _ in range(options.faults_a_job):
            time.sleep(chance.uniform(0, takes_s) / options.faults_a_job)
            seconds = strike(farm, kind, chance)
            if seconds is not None:
                noticed.append(seconds)
        end = job.end()
        is_right = end["bytes"] == expected
        tally["right" if is_right else "wrong"] += 1
        if not is_right:
            print("wrong:", end["error"] or "the picture differs", flush=True)
        losses = len(end["stats"].get("losses", []))
        tally["losses"] += losses
        if losses == 1:
            cpu.append((farm.cpu_s() - cpu_before_s) / cpu_s)
    return {"pictures": options.faults, "right": tally["right"], "losses": tally["losses"],
            "noticed_s": round(statistics.median(noticed), 3) if noticed else None,
            "cpu_of_one_loss": round(statistics.median(cpu), 3) if cpu else None}, tally["wrong"]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("command")
    parser.add_argument("scene")
    parser.add_argument("--faults", type=int, default=25)
    parser.add_argument("--faults-a-job", type=int, default=1)
    parser.add_argument("--usual", type=int, default=5)
    parser.add_argument("--kinds", default="kill,stop")
    parser.add_argument("--nodes", default="8,16")
    parser.add_argument("--algorithms", default="macro,roth")
    parser.add_argument("--size", default="2048x2048")
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    chance = random.Random(options.seed)
    wrong = 0
    with tempfile.TemporaryDirectory() as folder:
        expected = serial_picture(options.command, options.scene, options.size, folder)
        for nodes in options.nodes.split(","):
            farm = Farm(options.command, folder, nodes, "--retries", "100")
            for algorithm in options.algorithms.split(","):
                for kind in options.kinds.split(","):
                    row, bad = torture(farm, options, kind, algorithm, folder, expected, chance)
                    wrong += bad
                    print(f"{kind:5} {algorithm:6} {nodes:>4} nodes: {json.dumps(row)}", flush=True)
            farm.down()
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
