#!/usr/bin/env bash
# check.sh SCRIPT...: runs each generator with --check; exit status 1 if a file is not what its generator makes.
set -u
bad=0
for script in "$@"; do
    python3 "$script" --check || bad=1
done
exit $bad
