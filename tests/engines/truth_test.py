#!/usr/bin/python3
"""Tests the words by which tools/port/engines/truth.py judges a verdict; needs no engine."""
import pathlib
import sys
import unittest

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tools" / "port" / "engines"))
import truth

WRONG = "wrong: 6 of 1728 pixels have values that no right port reaches, and no single mistake explains them all"


class Judgment(unittest.TestCase):
    def check(self, expected, true, status, verdict):
        self.assertEqual(truth.judgment(true, status, verdict), expected)

    def test_a_verdict_is_true_if_it_says_right_of_a_right_picture_or_names_the_mistake(self):
        self.check("true", None, 0, "right: structure exact at all 1728 pixels")
        self.check("true", truth.left_over(4), 1, "wrong: the nearest 4 layers are composited, the others in the order of submission")

    def test_right_for_a_wrong_picture_and_a_mistake_of_a_right_one_are_false(self):
        self.check("false", truth.left_over(4), 0, "right: structure exact at all 1728 pixels")
        self.check("false", None, 1, "wrong: layers are averaged")
        self.check("false", truth.left_over(4), 1, "wrong: layers are averaged")

    def test_wrong_without_a_name_is_an_accusation_only_of_a_right_picture(self):
        self.check("wrong without a name", truth.left_over(4), 1, WRONG)
        self.check("right called wrong without a name", None, 1, WRONG)

    def test_a_verdict_that_is_not_decided_is_neither_true_nor_false(self):
        for true in (None, truth.left_over(4)):
            self.check("not decided", true, 1, "not decided: a right port may leave all 1728 pixels; rounding at most 3 codes where 3 are possible")


if __name__ == "__main__":
    unittest.main()
