"""board.py FOLDER SECONDS KERNEL INITRD: boots the board under QEMU, plays what its tests ask for, and judges them.

FOLDER gets console.log and out/TEST/ (what each test wrote). Exit status 0: every test passed; 77: some could not run and
none failed; 1: one failed, did not end within SECONDS, or the board died. Lines `note:` and `figure:` of the tests are shown.
"""
import os
import pathlib
import signal
import socket
import subprocess
import sys
import time

from hooks import Hooks
from qtest import Monitor, Qtest

MACHINE = ["-cpu", "cortex-a53", "-accel", "tcg,thread=multi", "-m", "384", "-nodefaults", "-display", "none", "-no-reboot",
           "-object", "can-bus,id=bus", "-device", "kvaser_pci,canbus=bus", "-device", "kvaser_pci,canbus=bus",
           "-smp", os.environ.get("RIG_CPUS", "2")]
# Names of the GPIO chip's lines 0-7, which a real board has from its device tree. 3 is what the machine has its key on.
LINES = ["ENC_A", "ENC_B", "BUTTON", "POWER_KEY", "TOGGLE", "LAMP_NIGHT", "LAMP_BUS", "SPARE"]


def device_tree(path):
    """The machine's own device tree, with names for the GPIO lines. Returns the chip's address."""
    subprocess.run(["qemu-system-aarch64", "-M", f"virt,dumpdtb={path}"] + MACHINE, check=True, stderr=subprocess.DEVNULL)
    nodes = subprocess.run(["fdtget", "-l", path, "/"], check=True, capture_output=True, text=True).stdout.split()
    chip = next(node for node in nodes if node.startswith("pl061@"))
    subprocess.run(["fdtput", "-t", "s", path, "/" + chip, "gpio-line-names"] + LINES, check=True)
    return int(chip.partition("@")[2], 16)


def connect(path, process, until):
    """The socket at path, which QEMU makes soon after its start."""
    while time.monotonic() < until and process.poll() is None:
        link = socket.socket(socket.AF_UNIX)
        try:
            link.connect(path)
            return link
        except OSError:
            link.close()
            time.sleep(0.05)
    raise TimeoutError("QEMU does not answer")


class Board:
    def __init__(self, folder, seconds, kernel, initrd):
        self.folder, self.until = folder, time.monotonic() + seconds
        self.start = time.monotonic()
        self.failed, self.skipped, self.passed, self.running = [], [], [], None
        sockets = {name: os.path.relpath(folder / name) for name in ("line", "qtest", "monitor")}
        for name in sockets.values():
            pathlib.Path(name).unlink(missing_ok=True)
        address = device_tree(folder / "board.dtb")
        command = ["qemu-system-aarch64", "-M", "virt"] + MACHINE + [
            "-dtb", folder / "board.dtb", "-kernel", kernel, "-initrd", initrd, "-append", "console=ttyAMA0 quiet panic=-1 rdinit=/init",
            "-serial", f"file:{folder}/console.log",
            "-qtest", f"unix:{sockets['qtest']},server=on,wait=off", "-qtest-log", "/dev/null",
            "-qmp", f"unix:{sockets['monitor']},server=on,wait=off",
            "-chardev", f"socket,id=line,path={sockets['line']},server=on,wait=off",
            "-device", "virtio-serial-pci", "-device", "virtserialport,chardev=line,name=rig",
            "-virtfs", f"local,path={folder}/out,mount_tag=out,security_model=none"]
        self.process = subprocess.Popen(command, stdin=subprocess.DEVNULL)
        try:
            links = {name: connect(path, self.process, self.until) for name, path in sockets.items()}
            self.line = links["line"]
            qtest = Qtest(links["qtest"])
            qtest.watch(Monitor(links["monitor"], self.process.pid), address)
            self.hooks = Hooks(qtest)
        except BaseException:
            self.close()
            raise

    def lines(self):
        """What the board says, line by line, until it ends or its time is over."""
        rest = b""
        while True:
            left = self.until - time.monotonic()
            if left <= 0:
                raise TimeoutError(f"no end within the time: {self.running or 'boot'} was running")
            self.line.settimeout(left)
            try:
                chunk = self.line.recv(4096)
            except socket.timeout:
                continue
            if not chunk:
                return
            *whole, rest = (rest + chunk).split(b"\n")
            yield from (text.decode(errors="replace").strip() for text in whole)

    def verdict(self, name, status):
        took = time.monotonic() - self.test_start
        log = (self.folder / "out" / name / "log").read_text(errors="replace").splitlines()
        word = {"0": "ok", "77": "SKIPPED"}.get(status, "FAILED")
        {"ok": self.passed, "SKIPPED": self.skipped}.get(word, self.failed).append(name)
        print(f"{word:8}{name:32}{took:6.1f} s" + ("" if word == "ok" else ": " + (log[-1] if log else "no output")))
        for text in log:
            if text.startswith(("note:", "figure:")):
                print(text)
        if word == "FAILED":
            print("".join(f"    {text}\n" for text in log[-40:]), end="", flush=True)

    def follow(self):
        for text in self.lines():
            verb, _, rest = text.partition(" ")
            if verb == "do":
                self.line.sendall(self.hooks.answer(rest).encode() + b"\n")
            elif verb == "start":
                self.running, self.test_start = rest, time.monotonic()
            elif verb == "verdict":
                self.verdict(*rest.rsplit(" ", 1))
                self.running = None
            elif verb == "boot":
                print(f"figure: board: first test {time.monotonic() - self.start:.1f} s after power on")
            elif verb == "end":
                self.process.wait(max(1.0, self.until - time.monotonic()))
                print(f"figure: board: power on to power off {time.monotonic() - self.start:.1f} s")
                return
        raise RuntimeError(f"the board died: {self.running or 'boot'} was running")

    def close(self):
        if self.process.poll() is None:
            self.process.kill()
            self.process.wait()


def show_console(folder):
    for text in (folder / "console.log").read_text(errors="replace").splitlines()[-25:]:
        print("    console: " + text)


def show(board, folder, problem):
    """What is known of a board that gave no verdict."""
    print(f"FAILED  {problem}")
    if board.running:
        log = folder / "out" / board.running / "log"
        if log.is_file():
            print("".join(f"    {text}\n" for text in log.read_text(errors="replace").splitlines()[-40:]), end="")
    for text in (folder / "console.log").read_text(errors="replace").splitlines()[-25:]:
        print("    console: " + text)


def main():
    folder = pathlib.Path(sys.argv[1])
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(1))
    try:
        board = Board(folder, float(sys.argv[2]), sys.argv[3], sys.argv[4])
    except (OSError, RuntimeError, subprocess.SubprocessError) as problem:
        print(f"FAILED  no board: {problem}")
        return 1
    try:
        board.follow()
    except (OSError, RuntimeError, subprocess.SubprocessError) as problem:
        board.failed.append(board.running or "boot")
        show(board, folder, problem)
    except KeyboardInterrupt:
        return 130
    finally:
        board.close()
    print(f"board: {len(board.passed)} passed, {len(board.failed)} failed, {len(board.skipped)} skipped")
    if board.failed:
        print(f"logs: {folder}/console.log {folder}/out/*/log")
        return 1
    return 77 if board.skipped else 0


sys.exit(main())
