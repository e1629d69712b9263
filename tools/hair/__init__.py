"""Modelling of hair: the skull as seen from its middle, shells over it, tubes beside it."""
