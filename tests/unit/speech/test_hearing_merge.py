"""What is listened for where text and sound differ."""

from mien.speech.hearing_merge import Difference, merge_words


def listened(text: str, heard: str) -> tuple[str, int, tuple[Difference, ...]]:
    wanted, said = text.split(), heard.split()
    merge = merge_words(wanted, said)
    return " ".join(wanted[own] if own >= 0 else said[other].upper() for own, other in merge.words), *(
        merge.agreed,
        merge.differences,
    )


def test_equal_words_are_the_text():
    assert listened("a b c", "a b c") == ("a b c", 3, ())


def test_few_words_misheard_are_the_text():
    assert listened("the old red barn stood", "the odd bread barn stood") == ("the old red barn stood", 3, ())


def test_few_words_missed_are_the_text():
    assert listened("one two three four five", "one five") == ("one two three four five", 2, ())


def test_many_words_missed_are_left_out():
    words, agreed, differences = listened("one a b c d two", "one two")
    assert (words, agreed) == ("one two", 2)
    assert differences == (Difference((1, 5), (1, 1)),)


def test_many_words_more_are_as_they_are_heard():
    words, agreed, differences = listened("one two", "one a b c d two")
    assert (words, agreed) == ("one A B C D two", 2)
    assert differences == (Difference((1, 1), (1, 5)),)


def test_the_text_may_go_on():
    assert listened("one two three four five six seven", "one two") == ("one two", 2, ())
    assert listened("one two three four five six seven", "one too") == ("one two", 1, ())


def test_without_a_text_all_is_as_heard():
    assert listened("", "one two three four")[0] == "ONE TWO THREE FOUR"
