"""What the picture of the hard cases shows, for the test that draws it anew without the runs:
a line for each case and method with its findings by verdict and its largest share of a bound."""
import json
import sys

VERDICTS = ["stable", "drift", "unstable", "failed"]
lines = {}
for row in map(json.loads, open(sys.argv[1])):
    line = lines.setdefault((row["case"], row["method"]), {"counts": [0] * len(VERDICTS), "share": 0.0})
    line["counts"][VERDICTS.index(row["verdict"])] += 1
    if row["value"] is not None and row["bound"] > 0:
        line["share"] = max(line["share"], abs(row["value"]) / row["bound"])
with open(sys.argv[2], "w") as out:
    out.write("\t".join(["case", "method", *VERDICTS, "largest share of a bound"]) + "\n")
    for (case, method), line in lines.items():
        out.write("\t".join([case, method, *map(str, line["counts"]), f"{line['share']:.3g}"]) + "\n")
