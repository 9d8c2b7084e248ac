#!/usr/bin/env bash
# The selections of config.sh on x86-64.
CONFIG=x86 exec bash "$(dirname "$0")/config.sh"
