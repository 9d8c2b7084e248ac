# Ctrl-C, a full disk and files of an earlier run: what is there afterwards is whole, old or new.
. tests/picture/lib.sh

whole() { for f in "$@"; do oiiotool --stats "$f" >"$work/info" 2>&1 && ! grep -q ERROR "$work/info" || same "$f is whole" "$(head -n 1 "$work/info")" whole; done; }

# interrupt DELAY COMMAND...: starts it and sends SIGINT after a while; bash ignores it for background jobs otherwise.
interrupt() {
    setsid bash -c 'trap - INT; exec "$@"' start env --default-signal=INT "${@:2}" >"$work/stdout" 2>"$work/stderr" &
    local pid=$!
    sleep "$1"
    kill -INT $pid 2>/dev/null
    wait $pid
    status=$?
    cases=$((cases + 1))
}

# ---- a track: the pictures done so far stay, whole; table and sheet of the run before stay as they were
flight=tools/flight/dusk-lszh-loww.csv
mkdir "$work/t"
echo old >"$work/t/track.csv"
echo old >"$work/t/contact-sheet.png"
interrupt 1 "$skyvert" track $flight --every 1s --size 256x256 --out "$work/t"
[ $status -eq 130 ] || fails "interrupted track" "want status 130"
n=$(ls "$work/t" | grep -c exr)
[ "$n" -gt 0 ] || same "interrupted track: pictures so far" "$n" "some"
same "interrupted track: nothing half-written" "$(ls -A "$work/t" | grep -v -e '^sky-.*\.exr$' -e '^track.csv$' -e '^contact-sheet.png$')" ""
same "interrupted track: the old table" "$(cat "$work/t/track.csv")" old
same "interrupted track: the old sheet" "$(cat "$work/t/contact-sheet.png")" old
whole "$work"/t/*.exr
echo "figure: interrupted after $n pictures, all whole"

# ---- a picture, interrupted at various moments: the old file or the new one
for i in 1 2 3 4 5 6 7 8; do
    echo old >"$work/p.exr"
    interrupt 0.0$((i * 9)) "$skyvert" render --sun-zenith-deg 60 --ground none --tier fast --size 300x300 --out "$work/p.exr"
    [ $status -eq 130 ] || [ $status -eq 0 ] || fails "interrupted picture $i" "want status 130 or 0"
    [ "$(head -c 3 "$work/p.exr")" = old ] || whole "$work/p.exr"
    same "interrupted picture $i: nothing beside it" "$(ls -A "$work" | grep -F .part)" ""
done

# ---- a full disk: a small tmpfs of our own, or a limit on the size of files where that is not allowed
cat >"$work/full.sh" <<'END'
set -u
skyvert=$1 folder=$2 flight=$3
if mount -t tmpfs -o size=64k none "$folder" 2>/dev/null; then echo "on a tmpfs of 64 KiB"; else
    trap '' XFSZ
    ulimit -f 60
    echo "with a limit of 60 KiB a file"
fi
echo old >"$folder/sky.png"; echo old >"$folder/sky.exr"; echo old >"$folder/mesh.ply"; mkdir "$folder/t"; echo old >"$folder/t/track.csv"
try() { "${@:2}" >"$folder.out" 2>"$folder.err" </dev/null; echo "$1: $? $(wc -l <"$folder.err") $(cat "$folder.err")"; }
try png "$skyvert" render --sun-zenith-deg 60 --size 400x400 --out "$folder/sky.png"
try exr "$skyvert" render --sun-zenith-deg 60 --size 400x400 --out "$folder/sky.exr"
try ply "$skyvert" dome --sun-zenith-deg 60 --rings 100 --azimuths 200 --out "$folder/mesh.ply"
try track "$skyvert" track "$flight" --every 5min --size 100x100 --out "$folder/t"
(cd "$folder" && find . -type f | sort | xargs grep -lx old | xargs echo left:)
(cd "$folder" && echo half: $(find . -name '*.part*'))
END
mkdir "$work/disk"
run /dev/null unshare -m bash "$work/full.sh" "$skyvert" "$work/disk" "$PWD/$flight"
[ $status -eq 0 ] || run /dev/null bash "$work/full.sh" "$skyvert" "$work/disk" "$PWD/$flight"
text=$(cat "$work/stdout")
echo "note: full disk: $(head -n 1 <<<"$text")"
for what in png exr ply track; do
    same "full disk, $what: status 1 and one line" "$(grep "^$what:" <<<"$text" | cut -d' ' -f2,3)" "1 1"
    grep -Eq "^$what: .*(No space left|too large)" <<<"$text" || same "full disk, $what: the cause" "$(grep "^$what:" <<<"$text")" "No space left"
done
has "full disk: the old files" "$text" "left: ./mesh.ply ./sky.exr ./sky.png ./t/track.csv"
same "full disk: nothing half-done" "$(grep '^half:' <<<"$text")" "half:"
finish
