# SPDX-License-Identifier: MIT
"""Tests of what a page says of a claim that does not hold."""
import unittest

import report_path  # noqa: F401
from made_up_run import verdict
from page import claims


class ClaimTest(unittest.TestCase):
    BUDGET = [
        {
            "cell": "a",
            "load": "strip-2",
            "strain": 0.01,
            "reference": "biot",
            "region": "all",
            "part": part,
            "share": value,
            "mean_m": value,
        }
        for part, value in (("slip", 0.8), ("rest", 0.2), ("total", 1.0))
    ]

    def claim(self, text, outcome, kind, name=""):
        made = {**verdict(text, outcome, 1.58, "< 1", kind), "id": name}
        return claims.claim_contents(made, [], "", self.BUDGET)

    def test_a_claim_that_names_no_strain_has_no_cause(self):
        text = ("stripes, biot, uniaxial-1, pulled: every strain has a periodic state on both meshes "
                "(paths that ended before)")
        self.assertEqual(self.claim(text, "INCONCLUSIVE", "method")["why"], "")

    def test_a_claim_on_the_method_that_fails_says_why_and_what_to_do(self):
        text = "a, strip-2: localized is closer to biot than affine at strain 0.01 (ratio)"
        row = self.claim(text, "FAIL", "method", "closer-than.affine")
        self.assertIn("which the anchor leaves out (80 % of it)", row["why"])
        self.assertIn("coarse mesh alone", row["advice"])
        self.assertEqual(self.claim(text, "PASS", "method")["advice"], "")
        row = self.claim(text, "INCONCLUSIVE", "method", "closer-than.affine")
        self.assertTrue(row["advice"].startswith("Not decided"), row["advice"])
        # What a method takes away is no reason for what it leaves.
        row = self.claim(text.replace("localized", "full"), "FAIL", "method")
        self.assertIn("most likely because cells are not small", row["why"])
        # Nor is what is left against another law.
        self.assertEqual(self.claim(text.replace("biot", "linear"), "FAIL", "method")["why"], "")
        row = self.claim(text.replace("localized is", "full is").replace("affine", "its base"),
                         "FAIL", "method", "closer-than.base")
        self.assertIn("without up-sampling", row["advice"])
        row = self.claim(text.replace("localized is", "full is").replace("affine", "localized"),
                         "FAIL", "method", "closer-than.localized")
        self.assertIn("take the paper's method", row["advice"])

    def test_every_kind_says_what_to_do_where_nothing_else_is_known(self):
        for kind, words in (
            ("program", "report it"),
            ("input", "homespun check"),
            ("method", "do not rest on it"),
        ):
            self.assertIn(words, self.claim("something else", "FAIL", kind)["advice"])
            # What is open condemns nothing.
            advice = self.claim("something else", "INCONCLUSIVE", kind)["advice"]
            self.assertTrue(advice.startswith("Not decided"), advice)

    def test_what_does_not_hold_stands_apart_from_what_holds(self):
        rows = [
            self.claim(str(i), outcome, "program")
            for i, outcome in enumerate(("PASS", "INCONCLUSIVE", "FAIL", "PASS"))
        ]
        (group,) = claims.claim_groups(rows)
        self.assertEqual([v["claim"] for v in group["open"]], ["2", "1"])
        self.assertEqual([v["claim"] for v in group["held"]], ["0", "3"])
        self.assertEqual(group["worst"]["verdict"], "FAIL")


if __name__ == "__main__":
    unittest.main()
