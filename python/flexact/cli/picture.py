"""``flexact picture``: a deck's mechanism as a picture, still or moving."""

from __future__ import annotations

import argparse

from flexact.batch import DeckFile, ExitCode, Outcome
from flexact.cli import remarks
from flexact.cli.analysed import add_decision, analysed, opened
from flexact.cli.bar import Bar
from flexact.cli.decks import take
from flexact.cli.showing import add_deck, add_shown, number, one_deck
from flexact.cli.terminal import say
from flexact.interruption import unwinding
from flexact.rendering import harmless

_QUANTITIES = ("N", "T", "My", "Mz")


def add_parser(verbs: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add this verb to the command's parser."""
    parser = verbs.add_parser(
        "picture",
        help="a deck's mechanism as a picture: its motion, its self-stress",
        description="Draw a mechanism: by default its first motion and its first self-stress.",
        allow_abbrev=False,
    )
    add_deck(parser, "the picture: .png, .svg, or .gif, which moves")
    add_shown(parser)
    parser.add_argument(
        "--stress", type=number, metavar="K", help="show self-stress K, coloured by its resultant"
    )
    parser.add_argument(
        "--quantity",
        choices=_QUANTITIES,
        help="of the self-stress: normal force, torsion, bending (default: the dominant one)",
    )
    parser.add_argument(
        "--view",
        default="iso",
        metavar="VIEW",
        help="iso (default), front, back, left, right, top, bottom, or AZ,EL: azimuth and "
        "elevation of the eye in degrees, as in --view=-60,25; z is up",
    )
    add_decision(parser)
    parser.set_defaults(run=draw_deck)


def draw_deck(chosen: argparse.Namespace) -> ExitCode:
    """Analyse the deck and draw it."""
    from flexact.outputs import plan_file, write_together

    deck, target = one_deck(chosen), chosen.output
    with unwinding():
        _check(chosen)
    plan_file(deck, target)

    def step(deck: DeckFile) -> Outcome:
        with Bar(deck.name, deck.path) as bar:
            model = opened(deck, bar)
            remarks.tell_problems(model)
            analysis = analysed(deck, model, chosen, bar)
            with unwinding():
                from flexact.picture import picture_bytes

                content = picture_bytes(
                    analysis,
                    target.suffix,
                    motion=chosen.motion,
                    freedom=chosen.freedom,
                    stress=chosen.stress,
                    quantity=chosen.quantity,
                    view=chosen.view,
                    progress=bar.show_frames,
                )
            with unwinding():
                write_together({target: content})
        say(f"{harmless(deck.name)}: drawn in {harmless(str(target))}")
        return Outcome(deck.name, ExitCode.ANALYSED, "drawn")

    return take([deck], step)


def _check(chosen: argparse.Namespace) -> None:
    """Find out what is wrong with the choice before anything is analysed."""
    from flexact.picture import check_packages, check_suffix, check_view

    check_suffix(chosen.output.suffix)
    check_packages()
    check_view(chosen.view)
