"""QEMU from outside: its GPIO chip by the qtest protocol, its device tree by QMP."""
import json
import queue
import threading
import time

PATIENCE = 2.0  # seconds
HANDLING_NS = 5000000  # of a processor's time, more than an interrupt and its thread take
MASKED_STATUS = 0x418  # of the PL061: interrupts of lines that are asked for and not yet taken


def run_time(task):
    """ns that a thread has run."""
    with open(task + "/schedstat", encoding="ascii") as file:
        return int(file.read().split()[0])


def asleep(task):
    """Whether a thread waits: a processor with nothing to do."""
    with open(task + "/stat", encoding="ascii") as file:
        return file.read().rpartition(")")[2].split()[0] == "S"


class Monitor:
    """QMP: one command, one answer; events are passed over."""

    def __init__(self, link, process):
        self.process = process
        self.stream = link.makefile("rw")
        self.stream.readline()
        self.ask("qmp_capabilities")

    def ask(self, command, **arguments):
        self.stream.write(json.dumps({"execute": command, "arguments": arguments}) + "\n")
        self.stream.flush()
        while True:
            answer = json.loads(self.stream.readline())
            if "return" in answer:
                return answer["return"]
            if "error" in answer:
                raise RuntimeError(answer["error"]["desc"])

    def find(self, kind):
        """Path of the first device of a kind."""
        for child in self.ask("qom-list", path="/machine/unattached"):
            if child["type"] == f"child<{kind}>":
                return "/machine/unattached/" + child["name"]
        raise RuntimeError(f"the machine has no {kind}")


class Qtest:
    """Lines in and out of one GPIO chip. Changes of its outputs: (seconds, line, level), in `changes`."""

    def __init__(self, link):
        self.link, self.answers, self.changes = link, queue.Queue(), []
        self.changed = threading.Condition()
        threading.Thread(target=self._read, daemon=True).start()

    def _read(self):
        for text in self.link.makefile("r"):
            words = text.split()
            if words and words[0] == "IRQ":
                with self.changed:
                    self.changes.append((time.monotonic(), int(words[2]), int(words[1] == "raise")))
                    self.changed.notify_all()
            else:
                self.answers.put(text.strip())

    def ask(self, command):
        self.link.sendall(command.encode() + b"\n")
        answer = self.answers.get(timeout=10)
        if not answer.startswith("OK"):
            raise RuntimeError(f"{command}: {answer}")
        return answer

    def watch(self, monitor, address):
        """Of the GPIO chip at this address."""
        self.path, self.address = monitor.find("pl061"), address
        self.tasks = [f"/proc/{monitor.process}/task/{cpu['thread-id']}" for cpu in monitor.ask("query-cpus-fast")]
        self.ask(f"irq_intercept_out {self.path}")

    def drive(self, line, level):
        """Sets an input, and waits until the board has taken note of it. On a busy machine the board is much slower than the
        clock, and an edge upon another would be lost: so time is counted in what the board's processors did."""
        self.ask(f"set_irq_in {self.path} unnamed-gpio-in {line} {level}")
        until = time.monotonic() + PATIENCE
        while int(self.ask(f"readl {self.address + MASKED_STATUS}").split()[1], 16) and time.monotonic() < until:
            time.sleep(0.0005)
        for task in self.tasks:
            self.let_run(task, until)

    @staticmethod
    def let_run(task, until):
        """Until a processor has had time enough, or was idle twice running: once may be a short wait for QEMU's own lock."""
        start, before, idle = run_time(task), -1, 0
        while idle < 2 and before - start < HANDLING_NS and time.monotonic() < until:
            now = run_time(task)
            idle = idle + 1 if asleep(task) and now == before else 0
            before = now
            time.sleep(0.001)
