// Texts of the help, a file for each language.

import { HELP_DE } from "../help/words_de.js";
import { HELP_EN } from "../help/words_en.js";
import { HELP_RU } from "../help/words_ru.js";
import { HELP_UK } from "../help/words_uk.js";

export const HELP_WORDS = { en: HELP_EN, de: HELP_DE, ru: HELP_RU, uk: HELP_UK };
