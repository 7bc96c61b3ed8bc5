"""What tests of real farms say and wait for."""

import time


class Failed(Exception):
    pass


def expect(is_so, what):
    print(("ok: " if is_so else "FAILED: ") + what, flush=True)
    if not is_so:
        raise Failed(what)


def wait_until(is_so, what, seconds=90):
    until = time.monotonic() + seconds
    while not is_so():
        if time.monotonic() > until:
            raise Failed("waited in vain: " + what)
        time.sleep(0.05)
