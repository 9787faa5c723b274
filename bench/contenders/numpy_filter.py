"""The bootstrap filter of the growth model as a numpy user writes it.

    python3 numpy_filter.py N SEED < observations > answer

Reads one observation a line. Writes the CPU seconds of the filtering, the bytes it took beyond those of numpy itself, then
the posterior mean of every step, one number a line.
"""
import resource
import sys
import time

import numpy as np


def resident_bytes():
    return 1024 * resource.getrusage(resource.RUSAGE_SELF).ru_maxrss


def resampled(states, weights, rng):
    """The systematic children of the states."""
    targets = (np.arange(len(states)) + rng.random()) / len(states)
    parents = np.searchsorted(np.cumsum(weights), targets)
    return states[np.minimum(parents, len(states) - 1)]


def filtered(observations, particles, seed):
    rng = np.random.default_rng(seed)
    states = np.sqrt(5.0) * rng.standard_normal(particles)
    started = time.process_time()
    means = []
    for t, y in enumerate(observations):
        push = 8 * np.cos(1.2 * t)
        states = states / 2 + 25 * states / (1 + states**2) + push + np.sqrt(10.0) * rng.standard_normal(particles)
        logs = -0.5 * (y - states**2 / 20) ** 2
        weights = np.exp(logs - logs.max())
        weights /= weights.sum()
        means.append(weights @ states)
        states = resampled(states, weights, rng)
    return time.process_time() - started, means


def main():
    observations = np.loadtxt(sys.stdin, ndmin=1)
    before = resident_bytes()
    seconds, means = filtered(observations, int(sys.argv[1]), int(sys.argv[2]))
    print(seconds, resident_bytes() - before, *means, sep="\n")


main()
