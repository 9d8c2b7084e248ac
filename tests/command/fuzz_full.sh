#!/usr/bin/env bash
# The seeded changes of fuzz.sh, many more.
ROUNDS=400000 exec bash "$(dirname "$0")/fuzz.sh"
