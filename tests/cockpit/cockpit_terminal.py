"""cockpit_terminal.py COCKPIT: its picture on a pseudo-terminal of several sizes; a clean end by a signal."""
import fcntl
import os
import pty
import re
import select
import signal
import struct
import sys
import termios
import time

SIZES = [(80, 24), (40, 15), (132, 50), (30, 6), (80, 24)]
bad = 0


def fail(text):
    global bad
    bad += 1
    print("FAIL:", text)


def resize(fd, size):
    fcntl.ioctl(fd, termios.TIOCSWINSZ, struct.pack("HHHH", size[1], size[0], 0, 0))


def read_for(fd, seconds):
    data, until = b"", time.monotonic() + seconds
    while time.monotonic() < until:
        if select.select([fd], [], [], 0.1)[0]:
            try:
                data += os.read(fd, 65536)
            except OSError:
                break
    return data.decode(errors="ignore").replace("\r\r\n", "\r\n")  # the terminal adds one


def plain(text):
    return re.sub(r"\x1b\[[0-9;?]*[A-Za-z]", "", text)


child, fd = pty.fork()
if child == 0:
    time.sleep(0.3)  # for the first size
    os.environ["TERM"] = "xterm-256color"
    os.execv(sys.argv[1], [sys.argv[1], "--fake", "--rate", "20", "--vertices", "512"])
resize(fd, SIZES[0])
everything = ""
for number, size in enumerate(SIZES):
    resize(fd, size)
    text = read_for(fd, 3.0 if number == 0 else 1.5)
    everything += text
    pictures = text.split("\x1b[H")
    whole = [p for p in pictures[1:-1]]
    if not whole:
        fail(f"{size}: no picture in {len(text)} bytes")
        continue
    lines = plain(whole[-1]).split("\r\n")
    if len(lines) > size[1] or max(len(line) for line in lines) > max(20, size[0]):
        fail(f"{size}: {len(lines)} lines, the longest of {max(len(line) for line in lines)}")
    if size[1] >= 15:
        words = plain(whole[-1])
        for wanted in ("Sun      azimuth", "Place    46.", " N  8.", "Height   ", "ft) above the sea", "UTC      2026-03-20 05:", "Bus      made-up flight", "Stale    nothing", "NE", "▀"):
            if wanted not in words:
                fail(f"{size}: no '{wanted}'")
        colours = set(re.findall(r"48;2;(\d+);(\d+);(\d+)m", whole[-1]))
        if len(colours) < 50:
            fail(f"{size}: {len(colours)} colours")
        # Dawn in the east: the brightest column of the strip's lowest row is the sun's, at 85 deg.
        rows = [re.findall(r"48;2;(\d+);(\d+);(\d+)m", line) for line in whole[-1].split("\r\n")]
        strip = [row for row in rows if len(row) == size[0]]
        light = [sum(int(c) for c in cell) for cell in strip[-3]]
        east = light[size[0] * 85 // 360]
        west = light[size[0] * 265 // 360]
        if not east > west:
            fail(f"{size}: east {east}, west {west}")
    elif "sun " not in plain(whole[-1]):
        fail(f"{size}: {plain(whole[-1])!r}")
os.kill(child, signal.SIGTERM)
everything += read_for(fd, 1.0)
_, status = os.waitpid(child, 0)
if status != 0:
    fail(f"status {status}")
if "\x1b[?1049h" not in everything or not everything.endswith("\x1b[0m\x1b[?25h\x1b[?1049l"):
    fail(f"the terminal is not given back: {everything[-40:]!r}")
sys.exit(bad > 0)
