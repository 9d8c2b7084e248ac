"""dbc.py DBC LOG CSV FOLDER [break]: a log of random values (random_log.c) read by two programs that know nothing of ours.

canmatrix decodes each frame by the DBC file; tshark decodes the log by tables that are made of the DBC file here. Each value
must be the one that was encoded. With "break" one signal of the DBC is moved by a byte first: then values must differ.
"""
import csv
import math
import os
import struct
import subprocess
import sys

import canmatrix.formats

TYPES = {2: "", 3: "_LONG", 30: "_DOUBLEH", 31: "_DOUBLEL"}


def read_log(path):
    """(id, data) of each frame."""
    frames = []
    for line in open(path, encoding="ascii"):
        identity, data = line.split()[2].split("#")
        frames.append((int(identity, 16), bytes.fromhex(data)))
    return frames


def by_canmatrix(database, frames):
    """For each frame: its signals by name."""
    by_id = {frame.arbitration_id.id: frame for frame in database.frames}
    return [{name: float(signal.phys_value) for name, signal in by_id[identity].decode(data).items()} for identity, data in frames]


def start_of(signal):
    """The bit at which a big-endian signal begins, counted from the first bit sent."""
    return signal.get_startbit(bit_numbering=1)


def tables(database, folder):
    """tshark's tables of signals; a signal begins where the one before it ends."""
    fields = []
    with open(f"{folder}/Signal_PDU_identifiers", "w") as names, open(f"{folder}/Signal_PDU_Binding_CAN", "w") as binding, open(
        f"{folder}/Signal_PDU_signal_list", "w"
    ) as table:
        for frame in database.frames:
            identity = frame.arbitration_id.id
            names.write(f'"{identity:08x}","{frame.name}"\n')
            binding.write(f'"{identity:08x}","00000000","{identity:08x}"\n')
            signals = sorted(frame.signals, key=lambda s: (start_of(s), s.mux_val or 0))
            for place, signal in enumerate(signals):
                kind = "float" if signal.is_float else "int" if signal.is_signed else "uint"
                only = -1 if signal.mux_val is None else signal.mux_val
                name = f"{frame.name.lower()}_{signal.name.lower()}"
                fields.append((f"signal_pdu.{name}", frame.name, signal.name))
                table.write(
                    f'"{identity:08x}","{len(signals)}","{place}","{signal.name}","{name}","{kind}","TRUE","{signal.size}",'
                    f'"{signal.size}","{signal.factor}","{signal.offset}","{str(signal.is_multiplexer).upper()}","{only}","FALSE"\n'
                )
    return fields


def by_tshark(database, log, folder):
    """For each frame: its signals by name."""
    fields = tables(database, folder)
    options = [word for field, _, _ in fields for word in ("-e", field)]
    run = subprocess.run(
        ["tshark", "-r", log, "-T", "fields", "-E", "separator=,"] + options,
        env=dict(os.environ, WIRESHARK_CONFIG_DIR=folder),
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        universal_newlines=True,
        check=False,
    )
    if run.returncode:
        sys.exit(f"tshark: {run.stderr}")
    rows = []
    for line in run.stdout.splitlines():
        rows.append({field[2]: float(text) for field, text in zip(fields, line.split(",")) if text})
    return rows


def value_of(kind, name, rows, last):
    """What a decoder says of the message whose last frame is `last`."""
    row = rows[last]
    if kind in (30, 31):
        halves = {**rows[last - 1], **row}
        return struct.unpack(">d", struct.pack(">II", int(halves[name + "_DOUBLEH"]), int(halves[name + "_DOUBLEL"])))[0]
    return row[name + TYPES[kind]]


def compare(reader, rows, wanted):
    """How many values differ; the first three are told."""
    wrong = 0
    for frame, identity, kind, name, want in wanted:
        try:
            if " " in want:
                row = rows[frame - 1]
                parts = [row.get(name + part) for part in PARTS[name]]
                ok = parts == [float(x) for x in want.split()[: len(parts)]]
                got = parts
            else:
                got = value_of(kind, name, rows, frame - 1)
                # LONG: half a count, 5e-8 deg or half a second, and the rounding of its sum. FLOAT and DOUBLE: the same
                # bits, but tshark prints 15 digits of a float.
                step = 0.5000001 * (1e-7 if identity in (1036, 1037) else 1) if kind == 3 else 0
                step = max(step, 1e-14 * math.fabs(float(want))) if reader == "tshark" and kind == 2 else step
                ok = math.fabs(got - float(want)) <= step
        except KeyError as missing:
            ok, got = False, f"no signal {missing}"
        if not ok:
            wrong += 1
            if wrong <= 3:
                print(f"{reader}: frame {frame}, id {identity}, type {kind}, {name}: got {got}, want {want}")
    return wrong


PARTS = {"UTC": ("Hour", "Minute", "Second"), "Date": ("Day", "Month", "Century", "YearOfCentury"), "SkyState": ("State", "Lamps", "StaleValues")}


def main():
    dbc, log, table, folder = sys.argv[1:5]
    database = canmatrix.formats.loadp_flat(dbc)
    if sys.argv[5:] == ["break"]:
        signal = database.frame_by_name("Latitude").signal_by_name("Latitude_LONG")
        signal.is_signed = False
    os.makedirs(folder, exist_ok=True)
    wanted = [(int(f), int(i), int(t), n, v) for f, i, t, n, v in csv.reader(open(table, encoding="ascii"))]
    frames = read_log(log)
    cycle = {frame.name: frame.attribute("GenMsgCycleTime", database) for frame in database.frames}
    wrong = compare("canmatrix", by_canmatrix(database, frames), wanted)
    wrong += compare("tshark", by_tshark(database, log, folder), wanted)
    if cycle["Latitude"] in (None, 0, "0"):
        sys.exit("the DBC has no cycle times")
    print(f"figure: DBC: {len(wanted)} values in {len(frames)} frames of {len({w[1] for w in wanted})} ids, {wrong} differ by canmatrix or tshark")
    sys.exit(wrong != 0)


main()
