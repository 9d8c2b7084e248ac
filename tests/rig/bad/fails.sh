fail "as it has to"
