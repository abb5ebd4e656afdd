"""The load sheet of a mission: what is on board where, and whether the aircraft stays in balance with it."""

from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import Any

from harness.errors import InputError
from harness.loading.aircraft import Stowage, read_stowage
from harness.loading.balance import Body, Item, combined
from harness.loading.envelope import percent
from harness.manual import FlightManual
from harness.mission.envelope import Envelope
from harness.mission.model import Mission
from harness.plan import Step
from harness.units import parse, show

MOST_RELEASED = 8  # point masses of mass-balance.xml that systems/payload.xml can move
FUEL_STEPS = 20  # states of the tanks at which the balance is looked at, from full to empty


class LoadSheet:
    """Masses and balance of a mission, through the whole flight."""

    def __init__(self, mission: Mission, manual: FlightManual) -> None:
        self.mission = mission
        self.manual = manual
        self.stowage: Stowage = read_stowage(mission.aircraft)
        payload = mission.loading.payload_of(manual.limits["operating-empty-mass"])
        bulk = self.stowage.bulk._replace(mass=payload)
        self.load: Sequence[Item] = mission.loading.items or (bulk,)

    def body(self, fuel: float, dropped: Sequence[str] = ()) -> Body:
        """The whole aircraft with `fuel` kg in its tanks, without the loads of those names."""
        kept = [item for item in self.load if item.name not in dropped]
        return combined([self.stowage.empty, *kept, *self.stowage.fuel(fuel)])

    def faults(self) -> Iterator[InputError]:
        """Pallets in each other's place; a balance outside its limits at take-off, or later with less fuel and load."""
        pallets = sorted(self.mission.loading.pallets, key=lambda pallet: pallet.item.x)
        for one, other in pairwise(pallets):
            gap = other.item.x - one.item.x - self.stowage.pallet.length
            if gap < -1e-9:
                what = f'pallets "{one.item.name}" and "{other.item.name}" overlap by {-gap:.2f} m'
                remedy = f"a pallet is {self.stowage.pallet.length:.2f} m long"
                yield self._fault(f"{other.path}", what, remedy)
        limits = self.manual.balance
        if limits is None:
            return
        released = self.mission.released
        for count in range(len(released) + 1):
            gone = released[:count]
            for step in range(FUEL_STEPS + 1):
                fuel = self.mission.loading.fuel * (1 - step / FUEL_STEPS)
                for told in limits.faults(self.body(fuel, gone)):
                    after = f" after the release of {gone[-1]}" if gone else ""
                    yield self._fault(
                        "loading",
                        f"with {show(fuel, 't', 1)} of fuel{after} {told}",
                        "put the load elsewhere",
                    )
                    return

    def drop_faults(self) -> Iterator[InputError]:
        """What stands in the way of a release along the route: a closed ramp, and more loads than can be moved."""
        released, ramp = self.mission.released, 0.0
        if len(released) > MOST_RELEASED:
            what = f"{len(released)} loads are released in flight"
            yield self._fault("loading", what, f"at most {MOST_RELEASED}; put several on one pallet")
        envelope, fastest = Envelope(self.mission, self.manual), self.manual.limits.get("ramp-speed")
        for leg in self.mission.legs:
            opening = any(
                _sets(action, "ramp") and parse(action.action["to"], "ratio") > 0 for action in leg.actions
            )
            speed = envelope.airspeeds(leg.speed, leg.level).cas
            if (ramp > 0 or opening) and fastest is not None and speed > fastest:
                what = f"{leg.name}: {leg.speed} is too fast with the ramp open"
                yield self._fault(f"{leg.path}/speed", what, f"at most {show(fastest, 'kt')} CAS")
            for action in leg.actions:
                if _sets(action, "ramp"):
                    ramp = parse(action.action["to"], "ratio")
                elif _sets(action, "release") and ramp < 1:
                    what = f'{leg.name}: "{action.name}" with the ramp not open'
                    remedy = 'set="ramp" to="1" at a waypoint before'
                    yield InputError(what, file=action.file, line=action.line, remedy=remedy)

    def _fault(self, path: str, what: str, remedy: str) -> InputError:
        file, line = self.mission.place(path)
        return InputError(what, file=file, line=line, remedy=remedy)

    def data(self) -> dict[str, Any]:
        """The sheet for a machine: kg, metres and shares of the mean chord."""
        manual, fuel = self.manual, self.mission.loading.fuel
        limits = manual.balance
        states = {"zero_fuel": self.body(0.0), "take_off": self.body(fuel)}
        tanks = zip(self.stowage.fuel(fuel), self.stowage.tanks, strict=True)
        return {
            "empty_mass_kg": self.stowage.empty.mass,
            "payload_kg": sum(item.mass for item in self.load),
            "items": [
                {"name": item.name, "mass_kg": item.mass, "x_m": item.x, "y_m": item.y} for item in self.load
            ],
            "fuel_kg": fuel,
            "tanks": [
                {"name": tank.name, "mass_kg": item.mass, "capacity_kg": tank.capacity}
                for item, tank in tanks
            ],
            "states": {
                name: {
                    "mass_kg": body.mass,
                    "maximum_mass_kg": manual.limits[_MAXIMUM[name]],
                    "cg_x_m": float(body.centre[0]),
                    "cg_y_m": float(body.centre[1]),
                    "cg_mac": None if limits is None else limits.share(body.centre[0]),
                    "cg_limits_mac": None if limits is None else limits.limits(body.mass),
                }
                for name, body in states.items()
            },
        }

    def __str__(self) -> str:
        manual, fuel = self.manual, self.mission.loading.fuel
        lines = [f"  {'empty aircraft':<16}{show(self.stowage.empty.mass, 'kg'):>12}"]
        passengers = self.mission.loading.passengers
        if passengers:
            mass = sum(item.mass for item in passengers)
            lines.append(f"  {f'{len(passengers)} passengers':<16}{show(mass, 'kg'):>12}")
        lines += [
            f"  {item.name[:15]:<16}{show(item.mass, 'kg'):>12}   at {item.x:.1f} m"
            for item in self.load[len(passengers) :]
        ]
        lines += [
            f"  {item.name:<16}{show(item.mass, 'kg'):>12}   of {show(tank.capacity, 'kg')}"
            for item, tank in zip(self.stowage.fuel(fuel), self.stowage.tanks, strict=True)
        ]
        for name, held in (("zero-fuel", 0.0), ("take-off", fuel)):
            body = self.body(held)
            most = manual.limits[_MAXIMUM[name.replace("-", "_")]]
            lines.append(f"  {f'{name} mass':<16}{show(body.mass, 'kg'):>12}   at most {show(most, 'kg')}")
            if manual.balance is not None:
                share, bounds = manual.balance.share(body.centre[0]), manual.balance.limits(body.mass)
                between = " to ".join(percent(bound) for bound in bounds)
                lines.append(f"  {'  balance':<16}{percent(share):>12}   {between}")
                side = f"{abs(body.centre[1]):.3f} m"
                lines.append(f"  {'  to the side':<16}{side:>12}   at most {manual.balance.lateral:.2f} m")
        return "\n".join(lines)


def _sets(action: Step, name: str) -> bool:
    return action.action.get("set") == name


_MAXIMUM = {"zero_fuel": "maximum-zero-fuel-mass", "take_off": "maximum-take-off-mass"}
