# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause
"""Programs that the tests start. Each is killed after its time, so that a hang becomes a message."""

import faulthandler
import signal
import subprocess
import sys

LONGEST = 300  # seconds; CTest waits for 600

faulthandler.dump_traceback_later(540, exit=True)  # where this process itself hangs


def run(arguments, **options):
    """subprocess.run(), which must succeed; killed after LONGEST seconds."""
    options.setdefault("check", True)
    return subprocess.run(arguments, timeout=LONGEST, **options)


def interrupted(program, seconds=60):
    """The standard error of a Python program that gets one SIGINT once it has printed a line.

    The child does not ignore it, even where this process does: a shell without job control starts what runs in
    the background so.
    """
    begin = "import signal\nsignal.signal(signal.SIGINT, signal.default_int_handler)\n"
    child = subprocess.Popen([sys.executable, "-X", "faulthandler", "-c", begin + program],
                             stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    said = ""
    try:
        said = child.stdout.readline()
        child.send_signal(signal.SIGINT)
        return child.communicate(timeout=seconds)[1]
    except subprocess.TimeoutExpired:
        child.send_signal(signal.SIGABRT)  # says where it is
        raise AssertionError(f"printed {said!r}, and then did not end:\n{child.communicate(timeout=10)[1]}")
    finally:
        child.kill()
        child.communicate()
