# Who includes what. The layers, and what each may include beside itself:
#   include/skyvert  its own earlier stages, stddef stdint
#   src/core         include/skyvert, stddef stdint stdbool float limits string (for memcpy)
#   src/scene        as src/core, and src/core's elementary.h
#   port/X           include/skyvert, its own headers, its library
#   tools            include/skyvert, port/*/ headers, its own headers, system headers; never src
# Tests may include anything.
BEGIN {
    plain = " stddef.h stdint.h stdbool.h float.h limits.h string.h "
    n = split("config status atmosphere frame table radiance work irradiance colour sun moonlight disc stars night water dome display skyvert", stage, " ")
    for (i = 1; i <= n; i++) order[stage[i] ".h"] = i
}
FNR == 1 {
    path = FILENAME
    sub(/^.*lint\/bad\/includes\//, "", path)
    layer = path ~ /^include\/skyvert\// ? "public" : path ~ /^src\/core\// ? "core" : path ~ /^src\/scene\// ? "scene" : path ~ /^port\// ? "port" : path ~ /^tools\// ? "tools" : "free"
    split(path, part, "/")
    self = part[3]
}
/^[ \t]*#[ \t]*include[ \t]*[<"]/ {
    system_header = $0 ~ /include[ \t]*</
    name = $0
    sub(/^[^<"]*[<"]/, "", name)
    sub(/[>"].*/, "", name)
    if (!allowed()) {
        printf "%s:%d: %s may not include %s\n", FILENAME, FNR, layer == "free" ? "this" : layer == "public" ? "include/skyvert" : layer ~ /core|scene/ ? "src/" layer : layer, name
        bad = 1
    }
}
function allowed() {
    if (layer == "free") return 1
    if (name ~ /(^|\/)src\//) return 0
    if (layer == "public") return system_header ? name == "stddef.h" || name == "stdint.h" : name ~ /^skyvert\// && order[substr(name, 9)] > 0 && order[substr(name, 9)] < order[self]
    if (layer == "core") return system_header ? index(plain, " " name " ") > 0 : name ~ /^(skyvert|core)\//
    if (layer == "scene") return system_header ? index(plain, " " name " ") > 0 : name ~ /^(skyvert|scene)\// || name == "core/elementary.h"
    if (name ~ /^(core|scene)\//) return 0
    if (layer == "port") return system_header || name ~ /^skyvert\// || name !~ /\// || name ~ ("^(port/)?" part[2] "/")
    return 1
}
END { exit bad }
