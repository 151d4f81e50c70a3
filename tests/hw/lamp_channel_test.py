#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Rakelight authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The lamp circuit, simulated by ngspice: lamp_channel_test.py NETLIST"""
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

NETLIST = pathlib.Path(sys.argv.pop(1)).read_text()
FLOATING_OHM = 1e12
DARK_A = 1e-6  # a LED that nobody sees
WORST_CAPACITOR = {"least": 22e-6 * 0.8, "most": 22e-6 * 1.2}


def simulate(**parameters):
    """Runs the netlist with these parameters. Returns what it measures, SI units; what did not happen is missing."""
    text = NETLIST
    for name, value in parameters.items():
        text, found = re.subn(rf"(?m)^\.param {name}=\S+", f".param {name}={value}", text)
        assert found == 1, f"no parameter {name}"
    with tempfile.NamedTemporaryFile("w", suffix=".cir") as deck:
        deck.write(text)
        deck.flush()
        out = subprocess.run(["ngspice", "-b", deck.name], capture_output=True, text=True, timeout=120).stdout
    return {name: float(value) for name, value in re.findall(r"(?m)^(\w+)\s+=\s+(\S+)", out)}


class LampChannel(unittest.TestCase):
    def test_the_gate_is_driven_hard_and_the_led_gets_its_current(self):
        lit = simulate()
        self.assertGreater(lit["gate_lit"], 2.5 + 0.5)  # R_DS(on) is specified at 2.5 V
        self.assertAlmostEqual(lit["i_lit"], 0.2, delta=0.01)
        self.assertLess(lit["p_r6_max"], 0.5)  # of the 1 W that R6 bears

    def test_the_current_does_not_depend_on_the_transistor(self):
        worst, best = simulate(vth=1.5), simulate(vth=0.65)
        self.assertAlmostEqual(worst["i_lit"] / best["i_lit"], 1, delta=0.005)

    def test_the_lamp_follows_the_pin(self):
        self.assertAlmostEqual(simulate(pulse=0.07)["t_on"], 0.07, delta=0.0005)

    def test_a_sequence_does_not_wear_the_one_shot_down(self):
        # a lamp that is lit two frames of every four, six times: far denser than a scan
        measured = simulate(pulse=0.0667, period=0.1333, tend=0.8)
        self.assertAlmostEqual(measured["t_on_last"], 0.0667, delta=0.0005)

    def test_the_lamp_is_off_while_the_pin_floats(self):
        self.assertLess(simulate(rpin=FLOATING_OHM, vrise=1.3, vfall=0.6)["i_max"], DARK_A)

    def test_the_lamp_is_off_while_a_pin_is_pulled_up_at_boot(self):
        self.assertLess(simulate(rpin=50e3, vrise=1.3, vfall=0.6)["i_max"], DARK_A)  # GPIO 0 to 8 of a Raspberry Pi

    def test_the_lamp_is_off_while_the_logic_has_no_supply(self):
        self.assertLess(simulate(vio=0)["i_max"], DARK_A)

    def test_the_one_shot_ends_the_light_of_a_stuck_pin(self):
        shortest = simulate(pulse=50, tend=6, vfall=1.5, cshot=WORST_CAPACITOR["least"])
        longest = simulate(pulse=50, tend=6, vfall=0.6, vrise=1.3, cshot=WORST_CAPACITOR["most"])
        print(f"FIGURE on-time of a stuck pin: {shortest['t_on']:.2f} to {longest['t_on']:.2f} s")
        self.assertGreater(shortest["t_on"], 1.0)
        self.assertLess(longest["t_on"], 5.0)


if __name__ == "__main__":
    if shutil.which("ngspice") is None:
        print("SKIPPED: ngspice is missing (scripts/setup installs it)", file=sys.stderr)
        sys.exit(77)
    unittest.main()
