"""rig.py FOLDER SECONDS BOARDS KERNEL INITRD GUEST TEST...: the tests of GUEST/TEST.sh on up to so many boards side by side.

FOLDER/board1 ... get console.log and out/TEST/ of each board. Exit status 0: every test passed; 77: some could not run and
none failed; 1: one failed, did not end within SECONDS, or a board died. Lines `note:` and `figure:` of the tests are shown.
"""
import pathlib
import re
import signal
import subprocess
import sys
import threading
import time

from board import Board


def takes(guest, test):
    """Seconds that a test takes on a quiet machine: the line `# takes: N` in it."""
    found = re.search(r"^# takes: (\d+)", (guest / f"{test}.sh").read_text(), re.MULTILINE)
    return int(found[1]) if found else 10


def deal(guest, tests, boards):
    """The longest first, each to the board that has least to do; as given where there is one board."""
    if boards == 1:
        return [tests]
    hands = [[] for _ in range(boards)]
    for test in sorted(tests, key=lambda test: -takes(guest, test)):
        min(hands, key=lambda hand: sum(takes(guest, other) for other in hand)).append(test)
    return [hand for hand in hands if hand]


def run(folder, seconds, boards, kernel, initrd, guest, tests):
    started, going = [], []
    try:
        for number, hand in enumerate(deal(guest, tests, boards), 1):
            started.append(Board(folder / f"board{number}", seconds, kernel, initrd, hand))
        going = [threading.Thread(target=board.run, daemon=True) for board in started]
        for thread in going:
            thread.start()
        for thread in going:
            thread.join()
    finally:
        for board in started:
            board.close()
    return started


def main():
    folder, seconds, boards, kernel, initrd, guest, *tests = sys.argv[1:]
    folder, start = pathlib.Path(folder), time.monotonic()
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(1))
    try:
        done = run(folder, float(seconds), int(boards), kernel, initrd, pathlib.Path(guest), tests)
    except (OSError, RuntimeError, subprocess.SubprocessError) as problem:
        print(f"FAILED  no board: {problem}")
        return 1
    except KeyboardInterrupt:
        return 130
    passed, failed, skipped = (sum(len(getattr(board, name)) for board in done) for name in ("passed", "failed", "skipped"))
    print(f"figure: rig: {len(tests)} tests, power on to verdict {time.monotonic() - start:.0f} s, boards: {len(done)}")
    print(f"rig: {passed} passed, {failed} failed, {skipped} skipped")
    if failed:
        print(f"logs: {folder}/board*/console.log {folder}/board*/out/*/log")
        return 1
    return 77 if skipped else 0


sys.exit(main())
