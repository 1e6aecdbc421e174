# SPDX-License-Identifier: MIT
"""Tests of the page of `homespun stress`."""
import unittest

from made_up_study import write_stress
from page_case import PageTest


class StressPageTest(PageTest):
    def test_stress_cases_that_do_not_hold_come_first(self):
        write_stress(self.folder)
        self.assertEqual(self.run_report(), (0, ""))
        page = self.page()
        self.assertIn("2 of 4 cases hold, 1 fails, 1 cannot be judged.", page)
        self.assertLess(page.index("sliver, 1e-6"), page.index("energy does not grow"))
        self.assertLess(page.index("energy does not grow"), page.index("contrast 1e12"))
        self.assertLess(page.rindex("sliver, 1e-6"), page.index("contrast 1e12"))
        self.assertLess(page.index("homespun stress"), page.index('id="verdicts"'))

    def test_stress_case_with_an_unknown_verdict_is_refused(self):
        write_stress(self.folder)
        self.edit("stress.csv", lambda text: text.replace("FAIL", "BAD"))
        self.assert_refused("stress.csv, line 3: `verdict` is `BAD`", "homespun stress")


if __name__ == "__main__":
    unittest.main()
