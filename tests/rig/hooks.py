"""What a test on the board can ask of the world outside, one line each, by `host COMMAND...` of lib.sh:

gpio LINE LEVEL              an input line of the GPIO chip (0-7) is driven to 0 or 1
wave MS:LINE:LEVEL ...       edges at these times from now on, in milliseconds, at the earliest; answers after the last
turn A B STEPS MS            an encoder on lines A and B turned by STEPS quarter steps (negative: backwards), MS between them
outputs                      LINE=LEVEL of each output that has changed since power on
changes LINE                 how often that output has changed since power on
await LINE LEVEL SECONDS     until the output has that level: the seconds it took
"""
import time

STEPS = ((0, 0), (0, 1), (1, 1), (1, 0))  # levels of A and B, forwards


class Hooks:
    def __init__(self, qtest):
        self.qtest, self.phase = qtest, {}

    def answer(self, text):
        """One line: `ok ...`, or `error ...`."""
        verb, *words = text.split()
        action = getattr(self, "do_" + verb, None)
        if not action:
            return f"error unknown command {verb}"
        try:
            return f"ok {action(*words)}".strip()
        except (TypeError, ValueError, RuntimeError) as problem:
            return f"error {problem}"

    def level(self, line):
        return next((level for _, which, level in reversed(self.qtest.changes) if which == line), None)

    def do_gpio(self, line, level):
        if line not in "01234567" or level not in "01":
            raise ValueError("a line is 0 to 7, a level 0 or 1")
        self.qtest.drive(int(line), int(level))
        return ""

    def do_wave(self, *edges):
        start = time.monotonic()
        for edge in edges:
            ms, line, level = edge.split(":")
            time.sleep(max(0.0, start + float(ms) / 1000 - time.monotonic()))
            self.qtest.drive(int(line), int(level))
        return f"{(time.monotonic() - start) * 1000:.1f}"

    def do_turn(self, a, b, steps, ms):
        a, b, steps = int(a), int(b), int(steps)
        for _ in range(abs(steps)):
            before = self.phase.get((a, b), 0)
            after = self.phase[(a, b)] = (before + (1 if steps > 0 else -1)) % 4
            for line, old, new in zip((a, b), STEPS[before], STEPS[after]):
                if old != new:
                    self.qtest.drive(line, new)
            time.sleep(float(ms) / 1000)
        return ""

    def do_outputs(self):
        lines = sorted({line for _, line, _ in self.qtest.changes})
        return " ".join(f"{line}={self.level(line)}" for line in lines)

    def do_changes(self, line):
        return sum(1 for _, which, _ in self.qtest.changes if which == int(line))

    def do_await(self, line, level, seconds):
        start = time.monotonic()
        with self.qtest.changed:
            if not self.qtest.changed.wait_for(lambda: self.level(int(line)) == int(level), float(seconds)):
                raise RuntimeError(f"output {line} is {self.level(int(line))}, not {level}, after {seconds} s")
        return f"{time.monotonic() - start:.3f}"
