#!/usr/bin/env bash
# All 20 random scenes.
SCENES=$(seq -s ' ' 1 20) exec bash "$(dirname "$0")/random.sh"
