"""What files say of the face that they show."""

import pytest

from mien.formats.notes import notes


@pytest.mark.parametrize(
    ("address", "told"),
    [("head:ada", "head:ada"), ("toon:olav+egg", "toon:olav+egg"), ("../faces/my.toon.json", "my.toon.json")],
)
def test_a_face_is_told_without_the_folders_that_it_lies_in(address: str, told: str) -> None:
    assert notes(address)["Face"] == told
