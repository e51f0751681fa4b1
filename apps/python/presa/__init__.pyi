from presa.environment import Environment as Environment
from presa.recordings import Recording as Recording
from presa.simulation import InputError as InputError
from presa.simulation import Simulation as Simulation
from presa.studies import cost as cost
from presa.studies import experiment as experiment
from presa.studies import run as run
from presa.studies import stability as stability

__all__ = ["Environment", "InputError", "Recording", "Simulation", "cost", "experiment", "run", "stability"]
