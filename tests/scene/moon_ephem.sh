#!/usr/bin/env bash
# The moon against a second, independent theory (PyEphem). Skips where python3-ephem is not installed.
set -eu -o pipefail
here=$(cd "$(dirname "$0")" && pwd)
for python in python3 /usr/bin/python3; do # Debian's module belongs to Debian's python
    if "$python" -c 'import ephem' 2>/dev/null; then
        "${B:-build}/tests/scene/moon_rows" | "$python" "$here/moon_ephem.py"
        exit
    fi
done
echo "moon against PyEphem: python3-ephem is not installed"
exit 77
