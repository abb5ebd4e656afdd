"""Writes the list of the properties that JSBSim itself makes: `python -m harness.plant.catalog > harness/lint/...txt`.

They are the catalogue of an aircraft that has one of everything and declares nothing.
"""

import re
import sys
from pathlib import Path
from tempfile import TemporaryDirectory

import jsbsim

from harness.plant.messages import Messages

BARE = """<?xml version="1.0"?>
<fdm_config name="bare" version="2.0" release="BETA">
  <metrics>
    <wingarea unit="M2">200</wingarea> <wingspan unit="M">40</wingspan> <chord unit="M">5</chord>
    <htailarea unit="M2">60</htailarea> <htailarm unit="M">20</htailarm>
    <vtailarea unit="M2">50</vtailarea> <vtailarm unit="M">17</vtailarm>
    <location name="AERORP" unit="M"><x>0</x><y>0</y><z>0</z></location>
  </metrics>
  <mass_balance>
    <ixx unit="KG*M2">4e6</ixx> <iyy unit="KG*M2">4e6</iyy> <izz unit="KG*M2">7e6</izz>
    <emptywt unit="KG">8e4</emptywt>
    <location name="CG" unit="M"><x>0</x><y>0</y><z>0</z></location>
    <pointmass name="load"><weight unit="KG">1</weight>
      <location unit="M"><x>0</x><y>0</y><z>0</z></location></pointmass>
  </mass_balance>
  <ground_reactions>
    <contact type="BOGEY" name="WHEEL"><location unit="M"><x>0</x><y>0</y><z>-4</z></location>
      <static_friction>0.8</static_friction> <dynamic_friction>0.5</dynamic_friction>
      <rolling_friction>0.02</rolling_friction>
      <spring_coeff unit="N/M">1e6</spring_coeff> <damping_coeff unit="N/M/SEC">1e5</damping_coeff>
      <max_steer unit="DEG">60</max_steer> <brake_group>LEFT</brake_group> <retractable>1</retractable></contact>
    <contact type="STRUCTURE" name="BELLY"><location unit="M"><x>0</x><y>0</y><z>-1</z></location>
      <static_friction>0.8</static_friction> <dynamic_friction>0.5</dynamic_friction>
      <spring_coeff unit="N/M">1e6</spring_coeff> <damping_coeff unit="N/M/SEC">1e5</damping_coeff></contact>
  </ground_reactions>
  <external_reactions/>
  <propulsion>
    <engine file="motor"><feed>0</feed><thruster file="airscrew">
      <location unit="M"><x>0</x><y>0</y><z>0</z></location>
      <orient unit="DEG"><roll>0</roll><pitch>0</pitch><yaw>0</yaw></orient>
    </thruster></engine>
    <tank type="FUEL"><location unit="M"><x>0</x><y>0</y><z>0</z></location>
      <capacity unit="KG">10</capacity> <contents unit="KG">5</contents></tank>
  </propulsion>
  <flight_control name="none"/>
  <aerodynamics/>
</fdm_config>
"""
MOTOR = '<electric_engine name="motor"><power unit="WATTS">1000</power></electric_engine>'
AIRSCREW = """<propeller name="airscrew" version="1.1">
  <ixx unit="KG*M2">500</ixx> <diameter unit="M">5</diameter> <numblades>8</numblades>
  <minpitch>0</minpitch> <maxpitch>80</maxpitch> <minrpm>600</minrpm> <maxrpm>800</maxrpm>
  <table name="C_THRUST" type="internal"><tableData> 0 0.1
   1 0.0</tableData></table>
  <table name="C_POWER" type="internal"><tableData> 0 0.1
   1 0.0</tableData></table>
</propeller>
"""


def own_properties() -> list[str]:
    """The names in JSBSim's catalogue, without indices."""
    with TemporaryDirectory() as folder:
        root = Path(folder)
        for name, text in (
            ("aircraft/bare/bare.xml", BARE),
            ("engine/motor.xml", MOTOR),
            ("engine/airscrew.xml", AIRSCREW),
        ):
            (root / name).parent.mkdir(parents=True, exist_ok=True)
            (root / name).write_text(text, encoding="utf-8")
        jsbsim.set_logger(Messages())
        fdm = jsbsim.FGFDMExec(folder)
        fdm.set_debug_level(0)
        fdm.load_model("bare")
        fdm.run_ic()
        catalogue = fdm.query_property_catalog("").split("\n")
    return sorted({re.sub(r"\[\d+\]", "", line.split(" ")[0]) for line in catalogue if "/" in line})


if __name__ == "__main__":
    head = f"# Properties JSBSim {jsbsim.__version__} makes itself, without indices: python -m harness.plant.catalog"
    sys.stdout.write("\n".join((head, *own_properties())) + "\n")
