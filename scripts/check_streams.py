# SPDX-License-Identifier: Apache-2.0
"""check_streams.py FILM WIDTH HEIGHT FPS: what ffprobe says of a film, as JSON on the standard input, and
the order of its MP4 boxes."""
import json
import struct
import sys

film, width, height, fps = sys.argv[1], *map(int, sys.argv[2:5])


def check(name, found, wanted):
    if found != wanted:
        sys.exit(f"{film}: {name} is {found}, not {wanted}")


def boxes():
    with open(film, "rb") as file:
        while len(head := file.read(8)) == 8:
            size, name = struct.unpack(">I4s", head)
            yield name.decode("latin-1")
            if size == 1:
                size = struct.unpack(">Q", file.read(8))[0] - 8
            file.seek(size - 8, 1)


streams = json.load(sys.stdin)["streams"]
check("number of streams", len(streams), 2)
video, audio = streams
for name, wanted in {
    "codec_name": "h264", "pix_fmt": "yuv420p", "width": width, "height": height,
    "color_space": "bt709", "color_transfer": "bt709", "color_primaries": "bt709",
    "avg_frame_rate": f"{fps}/1", "r_frame_rate": f"{fps}/1", "start_time": "0.000000",
}.items():
    check(name, video.get(name), wanted)
for name, wanted in {
    "codec_name": "aac", "sample_rate": "48000", "start_time": "0.000000",
}.items():
    check(name, audio.get(name), wanted)
frames = int(video["nb_frames"])
check("frames that decode", int(video["nb_read_frames"]), frames)
for stream in streams:
    check(f"duration of {stream['codec_name']}", stream["duration"], f"{frames / fps:.6f}")
order = list(boxes())
if order.index("moov") > order.index("mdat"):
    sys.exit(f"{film}: its table of contents follows the pictures")
