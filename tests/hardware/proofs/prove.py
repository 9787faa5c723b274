#!/usr/bin/env python3
"""Proves what a module of the circuits promises at its handshakes: prove.py RTL PROOF

PROOF.svh is put before the end of the module that its first line names, and states what is assumed and asserted. Its head:
    // module NAME  Parameter=value ...   of which there may be several, each proved
    // within STEPS   of a run from reset, and of the induction, which covers runs of any length
    // free   CELLS   whose outputs may be anything, of Yosys's kinds; may be left out
    // twin   TEXT -> TEXT   a mistake in the module that a run from reset must show
Yosys writes the module as gates, and its solver (MiniSat) does the temporal induction.
"""
import pathlib
import re
import subprocess
import sys
import tempfile


def wrong(text):
    sys.exit(f"prove.py: {text}")


def verdict(rtl, proof, head, mistake=None):
    """What Yosys prints about the module with its proof, and with a mistake if there is one."""
    module, parameters, within, free = head
    with tempfile.TemporaryDirectory() as scratch:
        for file in [*rtl.glob("*.sv"), *rtl.glob("filters/*.sv")]:
            text = file.read_text()
            if file.stem == module:
                if mistake:
                    if text.count(mistake[0]) != 1:
                        wrong(f"{proof.name}: twin: expected one place in {file.name}, got {text.count(mistake[0])}: "
                              f"{mistake[0]}. Follow what the module says now.")
                    text = text.replace(*mistake)
                end = text.rindex("endmodule")
                text = text[:end] + proof.read_text() + text[end:]
            else:  # what other modules promise is theirs to prove
                text = re.sub(r"^ *assert \(.*\n", "", text, flags=re.MULTILINE)
            (pathlib.Path(scratch) / file.name).write_text(text)
        values = "".join(f" -set {name} {value}" for name, value in parameters)
        script = (f"read_verilog -sv -formal -defer {scratch}/*.sv; chparam{values} {module}; prep -flatten -top {module}; "
                  f"{free}memory_map; async2sync; dffunmap; opt_clean; "
                  f"sat -tempinduct -prove-asserts -set-assumes -maxsteps {within}")
        done = subprocess.run(["yosys", "-p", script], capture_output=True, text=True, check=False)
        if done.returncode != 0:
            wrong(f"yosys: {done.stderr}")
        return done.stdout


def main():
    if len(sys.argv) != 3:
        wrong("expected RTL and PROOF. Pass the folder of the modules and a .svh file.")
    rtl, proof = map(pathlib.Path, sys.argv[1:])
    text = proof.read_text()
    free = "".join(f"cutpoint t:{kind}; " for line in re.findall(r"// free +(.*)", text) for kind in line.split())
    within = re.search(r"// within (\d+)", text)[1]
    twins = re.findall(r"// twin +(.+?) -> (.*)", text)
    if not twins:
        wrong(f"{proof.name}: twin: expected one or more, got none. Name a mistake that the proof must find.")
    for module, parameters in re.findall(r"// module (\w+)(.*)", text):
        head = module, re.findall(r"(\w+)=(\w+)", parameters), within, free
        printed = verdict(rtl, proof, head)
        if "Induction step proven: SUCCESS!" not in printed:
            wrong(f"{proof.name}: expected a proof, got none. Look at what is asserted.\n{printed[-6000:]}")
        for twin in twins:
            if "model found for base case: FAIL!" not in verdict(rtl, proof, head, twin):
                wrong(f"{proof.name}: twin: expected a run that shows it, got none: {' -> '.join(twin)}. Assert more.")
        print(f"{module}{parameters}: proved; {len(twins)} of {len(twins)} twins caught")


main()
