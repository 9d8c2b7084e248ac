#!/usr/bin/env bash
# All selections of config.sh, for Cortex-M4F and for x86-64.
CONFIG=m4f bash "$(dirname "$0")/config.sh" && CONFIG=x86 exec bash "$(dirname "$0")/config.sh"
