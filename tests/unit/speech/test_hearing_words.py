"""The words of a transcript as they are said."""

from mien.speech.hearing_words import Token, add_stress, pronounce, read_transcript

DICTIONARY = {
    "the": ("DH", "AH"),
    "well": ("W", "EH", "L"),
    "known": ("N", "OW", "N"),
    "dr": ("D", "R", "AY", "V"),
    "dog's": ("D", "AO", "G", "Z"),
}


def read(text: str):
    return read_transcript(text, DICTIONARY.get)


def test_words_of_the_dictionary_are_themselves():
    transcript = read("The “well-known” dog’s…")
    assert transcript.written == ("The", "well-known", "dog’s")
    assert [token.spellings for token in transcript.tokens] == [("the",), ("well",), ("known",), ("dog's",)]
    assert [token.owner for token in transcript.tokens] == [0, 1, 1, 2]
    assert transcript.learned == {}


def test_numbers_and_signs_are_said_in_full():
    transcript = read("2 & 50%")
    assert [token.owner for token in transcript.tokens] == [0, 1, 2]
    assert list(transcript.learned.values()) == [
        ("T", "UW"),
        ("AE", "N", "D"),
        ("F", "IH", "F", "T", "IY", "P", "ER", "S", "EH", "N", "T"),
    ]


def test_an_unknown_word_is_spelled_by_the_rules_of_the_voice():
    transcript = read("Zorblatt")
    assert transcript.tokens == (Token(("zorblatt~",), "Zorblatt", 0),)
    assert transcript.learned == {"zorblatt~": ("Z", "AO", "R", "B", "L", "AE", "T")}


def test_an_abbreviation_is_what_the_voice_says_too():
    transcript = read("Dr. Known")
    assert transcript.tokens[0].spellings == ("dr", "dr~")
    assert transcript.learned["dr~"] == ("D", "AA", "K", "T", "ER")


def test_what_nobody_can_say_is_named():
    transcript = read("The 🙂 日本")
    assert [token.spellings for token in transcript.tokens] == [("the",)]
    assert transcript.skipped == ("🙂", "日本")
    assert transcript.written == ("The", "🙂", "日本")


def test_stress_comes_from_the_voice():
    assert pronounce("beautiful") == ("B", "Y", "UW1", "T", "AH0", "F", "AH0", "L")
    assert add_stress(["B", "Y", "UW", "T", "IH", "F", "AH", "L"], "beautiful") == [
        *("B", "Y", "UW1", "T", "IH0", "F", "AH0", "L")
    ]


def test_the_first_vowel_is_stressed_where_the_voice_has_others():
    assert add_stress(["K", "AH", "M"], "beautiful") == ["K", "AH1", "M"]
    assert add_stress(["S", "T"], "st") == ["S", "T"]
