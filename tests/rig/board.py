"""One arm64 board under QEMU: boots, plays what its tests ask for, and judges them."""
import os
import pathlib
import socket
import subprocess
import threading
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


speaking = threading.Lock()


def say(text):
    """Lines that belong together, in one piece: boards work side by side."""
    with speaking:
        print(text, flush=True)


def tail(path, lines, before="    "):
    """The last lines of a file, indented, as far as there are any."""
    text = path.read_text(errors="replace").splitlines()[-lines:] if path.is_file() else []
    return "".join(f"\n{before}{line}" for line in text)


class Board:
    """FOLDER gets console.log and out/TEST/ (what each test wrote)."""

    def __init__(self, folder, seconds, kernel, initrd, tests):
        (folder / "out").mkdir(parents=True)
        self.folder, self.until = folder, time.monotonic() + seconds
        self.start = time.monotonic()
        self.failed, self.skipped, self.passed, self.running = [], [], [], None
        sockets = {name: os.path.relpath(folder / name) for name in ("line", "qtest", "monitor")}
        for name in sockets.values():
            pathlib.Path(name).unlink(missing_ok=True)
        address = device_tree(folder / "board.dtb")
        command = ["qemu-system-aarch64", "-M", "virt"] + MACHINE + [
            "-dtb", folder / "board.dtb", "-kernel", kernel, "-initrd", initrd, "-append", f"console=ttyAMA0 quiet panic=-1 rdinit=/init rig.tests={','.join(tests)}",
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
        path = self.folder / "out" / name / "log"
        log = path.read_text(errors="replace").splitlines()
        word = {"0": "ok", "77": "SKIPPED"}.get(status, "FAILED")
        {"ok": self.passed, "SKIPPED": self.skipped}.get(word, self.failed).append(name)
        text = f"{word:8}{name:32}{took:6.1f} s" + ("" if word == "ok" else ": " + (log[-1] if log else "no output"))
        for line in log:
            if line.startswith(("note:", "figure:")):
                text += "\n" + line
        say(text + (tail(path, 40) if word == "FAILED" else ""))

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
                say(f"figure: {self.folder.name}: first test {time.monotonic() - self.start:.1f} s after power on")
            elif verb == "end":
                self.process.wait(max(1.0, self.until - time.monotonic()))
                say(f"figure: {self.folder.name}: power on to power off {time.monotonic() - self.start:.1f} s")
                return
        raise RuntimeError(f"the board died: {self.running or 'boot'} was running")

    def close(self):
        if self.process.poll() is None:
            self.process.kill()
            self.process.wait()

    def run(self):
        """To the end of the last test; whatever ends the board before is a failure of the test that was running."""
        try:
            self.follow()
        except (OSError, RuntimeError, subprocess.SubprocessError) as problem:
            self.failed.append(self.running or "boot")
            log = self.folder / "out" / (self.running or "boot") / "log"
            say(f"FAILED  {problem}" + tail(log, 40) + tail(self.folder / "console.log", 25, "    console: "))
        finally:
            self.close()
