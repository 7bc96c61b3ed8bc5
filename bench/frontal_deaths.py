"""frontal_deaths.py GRAYCUBE SCENE [--deaths N] [--nodes N] [--size WxH] [--algorithm NAME] [--seed S]

Kills the frontal of a farm with --state at random moments of a job, N times, while other jobs wait,
and looks whether all end right: pictures equal to serial's, no number used twice, and how many of
the tiles that were whole when the frontal died were not traced again. Prints a line for each death
and a summary; ends with status 1 if something is wrong.
"""

import argparse
import json
import os
import random
import re
import signal
import sys
import tempfile
import time

from local_farm import Farm, Job, bytes_of, serial_picture

# A farm gives up after so many deaths of its frontal within a minute.
DEATHS_PER_FARM = 3
# Seconds of rendering before which a frontal isn't killed.
EARLIEST_S = 1.0


def kill_during(farm, job, fraction):
    """Kills the frontal once that part of the job is done; returns the tiles that were whole then."""
    rendering_since = None
    while True:
        info = farm.json("status", job)
        if info["state"] in ("done", "failed", "cancelled"):
            return None
        if info["state"] == "rendering" and rendering_since is None:
            rendering_since = time.monotonic()
        if (rendering_since is not None and info["fraction"] >= fraction
                and time.monotonic() - rendering_since >= EARLIEST_S):
            break
        time.sleep(0.02)
    pid = farm.json("status", "--farm")["pid"]
    whole = farm.json("status", job)["tiles_whole"]
    os.kill(pid, signal.SIGKILL)
    return whole


def one_death(farm, options, folder, expected, numbers, chance):
    fraction = chance.uniform(0.2, 0.8)
    job = Job(farm, options.scene, options.size, options.algorithm, folder)
    queued = [farm.run("submit", options.scene, "--size", "64x48").strip() for _ in range(2)]
    for number in (job.number, *queued):
        if number in numbers:
            raise SystemExit(f"number {number} was used twice")
        numbers.add(number)
    whole = kill_during(farm, job.number, fraction)
    end = job.end()
    is_right = end["bytes"] == expected[options.size]
    picture = os.path.join(folder, "b.exr")
    for number in queued:
        farm.run("watch", number)
        farm.run("fetch", number, "-o", picture)
        is_right = is_right and bytes_of(picture) == expected["64x48"]
    if whole is None:
        return None
    resumed = end["stats"].get("resumed_tiles", 0)
    return {"at": round(fraction, 2), "whole": whole, "resumed": resumed,
            "kept": round(min(1, resumed / max(1, whole)), 4), "is_right": is_right,
            "error": re.sub(r"\s+", " ", end["error"])}


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("command")
    parser.add_argument("scene")
    parser.add_argument("--deaths", type=int, default=30)
    parser.add_argument("--nodes", type=int, default=4)
    parser.add_argument("--size", default="2048x2048")
    parser.add_argument("--algorithm", default="macro")
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    chance = random.Random(options.seed)
    deaths, numbers = [], set()
    with tempfile.TemporaryDirectory() as folder:
        expected = {size: serial_picture(options.command, options.scene, size, folder)
                    for size in (options.size, "64x48")}
        while len(deaths) < options.deaths:
            farm = Farm(options.command, folder, options.nodes, "--state", os.path.join(folder, "state"))
            for _ in range(min(DEATHS_PER_FARM, options.deaths - len(deaths))):
                death = one_death(farm, options, folder, expected, numbers, chance)
                if death is not None:
                    deaths.append(death)
                    print(json.dumps(death), flush=True)
            farm.down()
    right = sum(death["is_right"] for death in deaths)
    kept = sum(death["resumed"] for death in deaths) / max(1, sum(death["whole"] for death in deaths))
    least = min(death["kept"] for death in deaths)
    print(f"{right} of {len(deaths)} right, {len(numbers)} numbers, {kept:.1%} of whole tiles kept, "
          f"at least {least:.1%}")
    return 0 if right == len(deaths) else 1


if __name__ == "__main__":
    sys.exit(main())
