# SPDX-License-Identifier: Apache-2.0
"""check_sound.py SOUND: what ffprobe says of a sound, on the standard input, against the motion.json
beside it."""
import json
import pathlib
import sys

sound = pathlib.Path(sys.argv[1])
told = json.loads((sound.parent / "motion.json").read_text(encoding="utf-8"))["sound"]
found = json.load(sys.stdin)["streams"][0]
print(f"{sound.parent.name}/{sound.name}: {found['sample_rate']} Hz, {found['duration']} s")
if int(found["sample_rate"]) != told["rate"] or abs(float(found["duration"]) - told["duration"]) > 2e-6:
    sys.exit(f"{sound}: motion.json says {told['rate']} Hz, {told['duration']} s")
