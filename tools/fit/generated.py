"""What the generators of headers share: write the file, or compare it with what would be written."""
import os
import sys


def write_or_check(args, path, text):
    """No argument: writes. --check: compares, status 1 and one line where it differs. Else a usage line, status 2."""
    path = os.path.relpath(path)
    if args == ["--check"]:
        with open(path) as f:
            same = f.read() == text
        print("%s: %s" % (path, "as generated" if same else "differs from what %s makes" % sys.argv[0]),
              file=sys.stdout if same else sys.stderr)
        return 0 if same else 1
    if args:
        print("usage: %s [--check]" % sys.argv[0], file=sys.stderr)
        return 2
    with open(path + ".new", "w") as f:
        f.write(text)
    os.replace(path + ".new", path)
    return 0
