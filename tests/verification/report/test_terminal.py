# SPDX-License-Identifier: MIT
"""The answer on the terminal says what the first screen of the page says."""
import unittest

import report_path  # noqa: F401  pylint: disable=unused-import

from page.terminal import COLUMNS, answer_text

NOTHING = {"in_short": [], "drapes": [], "loads": [], "stability": [], "convergence": [],
           "stress": [], "bends": []}


class Terminal(unittest.TestCase):
    def test_a_page_without_an_answer_says_nothing(self):
        self.assertEqual(answer_text({**NOTHING, "in_short": [{"name": "a", "lines": []}]}), "")

    def test_each_load_of_each_cell_has_its_sentence(self):
        line = {"title": "Strip along 1", "load": "strip-1", "sentence": "Half of it is left.",
                "beside": ""}
        text = answer_text({**NOTHING, "in_short": [
            {"name": name, "strain": "1 %", "lines": [line], "shown": [line], "infinite": None,
             "headline": "It pays.", "no_cause": "", "law": ""} for name in ("one", "two")]})
        self.assertEqual(text.count("  It pays.\n"), 2)
        self.assertEqual(text.count("Strip along 1 (strip-1): Half of it is left."), 2)
        self.assertEqual([t for t in text.split("\n") if t.endswith("strain:")],
                         ["one, at 1 % strain:", "two, at 1 % strain:"])

    def test_tags_and_entities_of_the_page_are_gone_and_lines_are_short(self):
        sentence = "C<sup>H</sup> &lt; 1 " + "and so on " * 30
        text = answer_text({**NOTHING, "drapes": [
            {"name": "a", "cells": [{"name": "a", "sentences": [sentence]}]}]})
        self.assertIn("  CH < 1 and so on", text)
        self.assertLessEqual(max(map(len, text.split("\n"))), COLUMNS)

    def test_a_name_of_text_keeps_its_brackets(self):
        cell = {"name": "warp<b>2", "sentences": ["a &lt; <i>b</i>"]}
        text = answer_text({**NOTHING, "stability": [{"name": "warp<b>2", "cells": [cell]}]})
        self.assertEqual(text, "warp<b>2:\n  a &lt; <i>b</i>")

    def test_a_count_stands_beside_its_study(self):
        text = answer_text({**NOTHING, "convergence": [{"name": "c", "sentence": "All hold."}]})
        self.assertEqual(text, "c:\n  All hold.")


if __name__ == "__main__":
    unittest.main()
