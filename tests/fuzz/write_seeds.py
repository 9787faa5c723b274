#!/usr/bin/env python3
"""Writes the seeds of the fuzz programs: write_seeds.py FOLDER makes FOLDER/<program>.corpus/ with tiny files.

They are what users write, so that a fuzzer starts from what works and the replay (replay.cpp) breaks it byte by byte.
"""

import pathlib
import sys

TABLES = [
    "t,y\n1,1100\n2,1000\n",
    "\ufefft,y\r\n1,1.5e3\r\n\r\n3,nan\r\n",
    "\"t\", y\n2,\n2,-.5\n7,+1e-400\n",
    "t,bearing,sensor_x,sensor_y,sensor_heading\n1,0.76,0,0,0\n1,0.7,0,0.01,0\n3,,,,\n",
    "t,x,vx,y,vy\n1,0.25,0.001,0.24,-0.005\n2,,,,\n",
    "t,doa1,doa2\n1,0.5,0.6\n2,nan,0.55\n",
    "t,level,note\n1,1120,3\n",
]
TOML = ("F = [[1, 0.5], [0, 1]]\nQ = [[1, 0], [0, 1]]\nH = [[1, 0]]\nR = 2\nmean = [0, 1]\n"
        "covariance = [[1, 0], [0, 1]]\nstates = [\"x\", \"v\"]\nobservations = [\"y\"]\n")
JSON = ('{"F": [[1, 0.5], [0, 1]], "Q": [[1, 0], [0, 1]], "H": [[1, 0]], "R": [[2]], "m0": [0, 1], '
        '"P0": [[1, 0], [0, 1]], "states": ["x", "v"]}')
TEXT_MODELS = [
    "name = \"g\"\n[parameters]\nq = 10.0\n[inputs]\ngain = 1\n[states]\nx = \"normal(0, sqrt(5))\"\n[next]\n"
    "x = \"0.5*x + 25*x/(1 + x^2) + 8*cos(1.2*(t - 1)) + sqrt(q)*normal(0, 1)\"\n[observations]\n"
    "y = \"normal(gain*x^2/20, 1)\"\n",
    "[states]\na = 1\nb = \"uniform(-pi, e)\"\n[noise]\nu = \"normal(0, 1)\"\n[next]\na = \"wrap(a + u)\"\n"
    "b = \"min(b, 2) - max(abs(u), .5)\"\n[observations]\nz = \"angle(atan2(a, b), exp(-b))\"\n"
    "log_likelihood = \"-(w - b^-2)^2 + log(z)\"\n",
]
WORDS = [
    "mean(x)", "sd(vx)", "median(y)", "q0.95(x)", "P(x>1.5)", "P(vy<-1e3)", "x",
    "q=2.5", "copies=2", "sigma_u=0.01\ndamping=0.9\nx0=-3", "q=1\nr=2\ncopies=2\np0=5\na=0.5\nomega=1.2",
    "--filter\nimh\n-n\n100\n--chains\n4\n--burn-in\nauto\n--improved",
    "--filter=distributed\n-n64\n--groups\n8\n--exchange\nswap\n--exchange-count\n2",
    "--resampler\nalias\n--ess-threshold\n0.5\n--seed\n7\n--precision\nfloat",
]
RUNS = [bytes([12 * model + choice]) + TABLES[table].encode()
        for choice in (0, 1, 2, 3, 4, 9) for model, table in ((0, 0), (1, 3), (2, 5), (3, 0), (3, 2))]
SEEDS = {
    "app.readers_fuzz": [text.encode() for text in TABLES],
    "app.matrices_fuzz": [TOML.encode(), JSON.encode()],
    "app.words_fuzz": [text.encode() for text in WORDS],
    "app.run_fuzz": RUNS,
    "graph.text_fuzz": [text.encode() for text in TEXT_MODELS],
}


def main():
    folder = pathlib.Path(sys.argv[1])
    for program, seeds in SEEDS.items():
        corpus = folder / f"{program}.corpus"
        corpus.mkdir(parents=True, exist_ok=True)
        for number, seed in enumerate(seeds):
            (corpus / f"seed{number:02}").write_bytes(seed)


if __name__ == "__main__":
    main()
